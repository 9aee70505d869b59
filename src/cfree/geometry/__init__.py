"""The geometry of contact surfaces: the paper's section 4, for both kinds of surface.

`local` has forms, curvatures and directions at a point; `rulings` what the lines on a surface say of it; `area` areas;
`development` unrolls v-e surfaces, with `elliptic` integrals; `congruence` finds equal helices, surfaces and patches;
`ruled` reads the eight numbers of a surface. The public names are in `cfree`.
"""
