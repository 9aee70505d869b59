"""The rational model of the configuration space: the paper's section 5.

`surd` has numbers with one square root, `model` contacts on fractions, `bezier` patches as rational Bezier surfaces.
The public names are in `cfree`.
"""
