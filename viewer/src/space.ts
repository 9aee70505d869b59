// The right view: the boundary of the forbidden space over x, y and theta.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  CatmullRomCurve3,
  Color,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  ShaderMaterial,
  Shape,
  ShapeGeometry,
  SphereGeometry,
  TubeGeometry,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Object3D,
  Path as ShapePath,
  Plane,
  PlaneGeometry,
  Sphere,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { type ColourBy, type Palette, on_scale, vertex_colours } from "./colours";
import { type Columns, bytes, doubles, integers } from "./engine";
import type { Shown } from "./model";
import { DepthOrder } from "./depth";
import { along_arc } from "./outlines";
import { FRAGMENT, VERTEX } from "./shaders";
import type { Gear } from "./vehicle";

const LOW = -Math.PI / 2;
const HIGH = (3 * Math.PI) / 2;
export const wrapped = (theta: number) => theta - 2 * Math.PI * Math.floor((theta - LOW) / (2 * Math.PI));
const GLASS = 0.8;
const STILL = 140; // ms after the last change: as fine as it gets

export class Space {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly parts = {
    surface: new Group(),
    picked: new Group(),
    slice: new Group(),
    path: new Group(),
    barrier: new Group(),
    box: new Group(),
  };
  private readonly point: Mesh;
  private readonly ends: Mesh[];
  private readonly material: ShaderMaterial;
  private readonly front: ShaderMaterial;
  private mesh?: Columns;
  private sorted?: DepthOrder;
  private colour_by: ColourBy = "contact";
  private view = { x: 0, y: 0, size: 1 }; // of the scene; theta is as high as it is wide
  private asked = false;
  private size = "";
  frames = 0; // drawn so far
  private still = 0;
  private is_held = false; // by a pointer that turns it
  private labels: { at: Vector3; element: HTMLElement }[] = [];
  private slice?: Columns;
  theta = 0;
  on_pick: (face: number, x: number, y: number, theta: number) => void = () => {};

  constructor(
    private readonly host: HTMLElement,
    private palette: Palette,
  ) {
    this.renderer = new WebGLRenderer({ antialias: false, alpha: true, powerPreference: "high-performance" });
    this.renderer.localClippingEnabled = true;
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute(
      "aria-label",
      "Configuration space: x, y and orientation. Arrow keys turn it, plus and minus zoom.",
    );
    host.append(canvas);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.ask());
    this.controls.addEventListener("start", () => {
      this.is_held = true;
    });
    this.controls.addEventListener("end", () => {
      this.is_held = false;
      this.ask();
    });
    this.material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      vertexColors: true,
      uniforms: {
        rise: { value: 1 },
        length: { value: 1 },
        opacity: { value: GLASS },
        cut: { value: 1e9 },
        dim: { value: 0 },
        faded: { value: 0 },
      },
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.front = this.material.clone();
    this.front.uniforms = this.material.uniforms;
    this.front.colorWrite = false;
    this.front.depthWrite = true;
    this.point = new Mesh(
      new SphereGeometry(1, 24, 16),
      new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.92 }),
    );
    this.ends = [0, 1].map(
      () =>
        new Mesh(
          new SphereGeometry(1, 20, 12),
          new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.75 }),
        ),
    );
    for (const ball of [this.point, ...this.ends]) ball.renderOrder = 7;
    this.scene.add(...Object.values(this.parts), this.point, ...this.ends);
    let down = { x: 0, y: 0 };
    canvas.addEventListener("pointerdown", ({ clientX: x, clientY: y }) => {
      down = { x, y };
    });
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - down.x, event.clientY - down.y) < 4) this.pick(event);
    });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.ask());
    new ResizeObserver(() => this.ask()).observe(host);
  }

  private get rise(): number {
    return (0.92 * this.view.size) / (2 * Math.PI);
  }
  private put(x: number, y: number, theta: number): Vector3 {
    return new Vector3(x - this.view.x, y - this.view.y, (theta - Math.PI / 2) * this.rise);
  }

  private box: [number, number, number, number] = [0, 0, 1, 1];
  // Begin a scene; another one than before is seen from the usual place.
  show_scene(box: [number, number, number, number], radius: number, is_other: boolean): void {
    this.box = box;
    const [x0, y0, x1, y1] = box;
    this.view = { x: (x0 + x1) / 2, y: (y0 + y1) / 2, size: Math.max(x1 - x0, y1 - y0) };
    for (const part of Object.values(this.parts)) this.clear(part);
    this.material.uniforms.rise!.value = this.rise;
    this.material.uniforms.length!.value = radius;
    this.mesh = undefined;
    this.sorted = undefined;
    for (const ball of [this.point, ...this.ends]) {
      ball.scale.setScalar(0.013 * this.view.size);
      ball.visible = false;
    }
    this.frame(box);
    if (is_other) {
      this.fade(false);
      this.home();
    } else this.ask();
  }
  // Mark the view as that of the scene before its last edit.
  fade(is: boolean): void {
    this.material.uniforms.faded!.value = is ? 0.62 : 0;
    this.ask();
  }

  home(): void {
    const size = this.view.size;
    this.camera.position.set(-1.24 * size, -2.21 * size, 1.33 * size);
    this.camera.near = 0.02 * size;
    this.camera.far = 12 * size;
    this.controls.target.set(0, 0, -0.02 * size);
    this.controls.update();
    this.ask();
  }

  private frame([x0, y0, x1, y1]: [number, number, number, number]): void {
    for (const { element } of this.labels) element.remove();
    this.labels = [];
    const corners = [
      [x0, y0],
      [x1, y0],
      [x1, y1],
      [x0, y1],
    ] as const;
    const points: number[] = [];
    const line = (a: Vector3, b: Vector3) => points.push(...a.toArray(), ...b.toArray());
    corners.forEach(([x, y], k) => {
      const [u, v] = corners[(k + 1) % 4]!;
      for (const z of [LOW, HIGH]) line(this.put(x, y, z), this.put(u, v, z));
      line(this.put(x, y, LOW), this.put(x, y, HIGH));
    });
    this.parts.box.add(this.lines(points, this.palette.faint, 0.9));
    const label = (at: Vector3, text: string, kind = "tick") => {
      const element = document.createElement("span");
      element.className = `label ${kind}`;
      element.textContent = text;
      this.host.append(element);
      this.labels.push({ at, element });
    };
    const off = 0.045 * this.view.size;
    for (let k = -1; k <= 3; ++k) label(this.put(x0 - off, y1 + off * 0.3, (k * Math.PI) / 2), `${90 * k}°`);
    label(this.put(x0 - 2.6 * off, y1 + off, Math.PI / 2), "θ", "axis");
    const step = 10 ** Math.floor(Math.log10(this.view.size / 2));
    const every = this.view.size / step > 6 ? 2 * step : step;
    const ticks = (from: number, to: number, at: (c: number) => Vector3) => {
      for (let c = Math.ceil(from / every) * every; c <= to + 1e-9 * every; c += every)
        label(at(c), String(Number(c.toPrecision(6))));
    };
    ticks(x0, x1, (c) => this.put(c, y0 - off, LOW));
    ticks(y0, y1, (c) => this.put(x1 + off, c, LOW));
    label(this.put((x0 + x1) / 2, y0 - 2.8 * off, LOW), "x", "axis");
    label(this.put(x1 + 2.8 * off, (y0 + y1) / 2, LOW), "y", "axis");
  }

  show_mesh(mesh: Columns): void {
    this.clear(this.parts.surface);
    this.mesh = mesh;
    const { geometry, triangles } = this.geometry(mesh);
    this.sorted = new DepthOrder(triangles, geometry.attributes.position!.array as Float32Array, this.rise);
    geometry.setIndex(this.sorted.attribute);
    this.host.dataset.triangles = String(triangles.length / 3);
    const surface = new Mesh(geometry, this.material);
    surface.name = "surface";
    surface.renderOrder = 2;
    // the front surface hides the lines behind it
    const front = new Mesh(geometry, this.front);
    front.renderOrder = 3;
    this.parts.surface.add(
      surface,
      front,
      ...this.edges(mesh, Math.min(0.9, Math.sqrt(4000 / (1 + bytes(mesh, "line_kind").length)))),
    );
    this.paint();
  }

  // For files: the mesh, and the view as it is now.
  get shown(): Shown | undefined {
    const surface = this.parts.surface.getObjectByName("surface") as Mesh | undefined;
    return (
      surface &&
      this.sorted && {
        geometry: surface.geometry,
        triangles: this.sorted.triangles,
        x: this.view.x,
        y: this.view.y,
        radius: this.material.uniforms.length!.value,
      }
    );
  }
  picture(): HTMLCanvasElement {
    this.draw(Math.max(2, devicePixelRatio), false);
    const { domElement: view } = this.renderer;
    const copy = document.createElement("canvas"); // before the browser clears it
    copy.width = view.width;
    copy.height = view.height;
    const to = copy.getContext("2d")!;
    const ratio = view.width / this.host.clientWidth;
    to.drawImage(view, 0, 0);
    to.scale(ratio, ratio);
    to.textAlign = "center";
    to.textBaseline = "middle";
    to.fillStyle = this.palette.ink;
    for (const { at, element } of this.labels) {
      const p = at.clone().project(this.camera);
      to.font = getComputedStyle(element).font;
      to.fillText(
        element.textContent!,
        ((p.x + 1) / 2) * this.host.clientWidth,
        ((1 - p.y) / 2) * this.host.clientHeight,
      );
    }
    return copy;
  }

  // Show the faces of a picked patch.
  highlight(faces: Int32Array | undefined): void {
    this.clear(this.parts.picked);
    const surface = this.parts.surface.getObjectByName("surface") as Mesh | undefined;
    if (surface && this.sorted && faces?.length) {
      const those = new Set(faces);
      const of: number[] = surface.geometry.userData.faces;
      const { triangles } = this.sorted;
      const kept: number[] = [];
      of.forEach((face, t) => {
        if (those.has(face)) kept.push(triangles[3 * t]!, triangles[3 * t + 1]!, triangles[3 * t + 2]!);
      });
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", surface.geometry.attributes.position!);
      geometry.setAttribute("normal", surface.geometry.attributes.normal!);
      geometry.setIndex(kept);
      const colour = new Color(this.palette.good);
      const colours = new Float32Array(surface.geometry.attributes.position!.count * 3);
      for (let k = 0; k < colours.length; k += 3) colour.toArray(colours, k);
      geometry.setAttribute("color", new BufferAttribute(colours, 3));
      const material = this.material.clone();
      Object.assign(material.uniforms, this.material.uniforms, { opacity: { value: 0.9 }, faded: { value: 0 } });
      const mesh = new Mesh(geometry, material);
      mesh.renderOrder = 4;
      this.parts.picked.add(mesh);
    }
    this.ask();
  }

  // Show the surface that separates start and goal.
  show_barrier(mesh: Columns | undefined): void {
    this.clear(this.parts.barrier);
    this.material.uniforms.dim!.value = mesh ? 0.86 : 0;
    if (mesh) {
      const { geometry, triangles } = this.geometry(mesh);
      geometry.setIndex(new BufferAttribute(triangles, 1));
      const colour = new Color(this.palette.barrier);
      const colours = new Float32Array(geometry.attributes.position!.count * 3);
      for (let k = 0; k < colours.length; k += 3) colour.toArray(colours, k);
      geometry.setAttribute("color", new BufferAttribute(colours, 3));
      const material = this.material.clone();
      material.uniforms.rise!.value = this.rise;
      material.uniforms.dim!.value = 0;
      material.depthWrite = true;
      const surface = new Mesh(geometry, material);
      material.uniforms.opacity!.value = 0.8;
      surface.renderOrder = 3;
      this.parts.barrier.add(surface, ...this.edges(mesh, 0.6));
    }
    this.ask();
  }

  // Look at the surface that separates start and goal from where all of it is seen.
  frame_barrier(): void {
    const box = new Box3().setFromObject(this.parts.barrier);
    if (box.isEmpty()) return;
    const ball = box.getBoundingSphere(new Sphere());
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    const half = (Math.min(this.camera.fov, this.camera.fov * this.camera.aspect) * Math.PI) / 360;
    this.controls.target.copy(ball.center);
    this.camera.position.copy(ball.center).addScaledVector(away, (1.05 * ball.radius) / Math.sin(half));
    this.controls.update();
    this.ask();
  }

  private geometry(mesh: Columns): { geometry: BufferGeometry; triangles: Uint32Array } {
    const xyz = doubles(mesh, "xyz");
    const corners = integers(mesh, "corners");
    const owner = integers(mesh, "owner");
    const face = integers(mesh, "face");
    const position = new Float32Array(xyz.length);
    for (let k = 0; k < xyz.length; k += 3) {
      position[k] = xyz[k]! - this.view.x;
      position[k + 1] = xyz[k + 1]! - this.view.y;
      position[k + 2] = xyz[k + 2]! - Math.PI / 2;
    }
    const kept: number[] = [];
    const faces: number[] = [];
    for (let k = 0; k < corners.length; k += 3)
      if (owner[corners[k]!] !== -1) {
        kept.push(corners[k]!, corners[k + 1]!, corners[k + 2]!);
        faces.push(face[k / 3]!);
      }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("normal", new BufferAttribute(Float32Array.from(doubles(mesh, "normal")), 3));
    geometry.userData.faces = faces;
    const triangles = Uint32Array.from(kept);
    return { geometry, triangles };
  }

  private edges(mesh: Columns, opacity: number): LineSegments[] {
    const lines = doubles(mesh, "lines");
    const kind = bytes(mesh, "line_kind");
    const points: number[][] = [[], [], [], []];
    for (let k = 0; k < kind.length; ++k)
      for (const at of [6 * k, 6 * k + 3])
        points[kind[k]!]!.push(...this.put(lines[at]!, lines[at + 1]!, lines[at + 2]!).toArray());
    const { ink, helix, segment } = this.palette;
    return [ink, helix, segment, helix].map((colour, k) => {
      const made = this.lines(points[k]!, colour, k === 0 ? 0.6 * opacity : opacity);
      made.renderOrder = 4;
      (made.material as LineBasicMaterial).clippingPlanes = [this.under];
      return made;
    });
  }

  private lines(points: number[], colour: string, opacity = 1): LineSegments {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    return new LineSegments(
      geometry,
      new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity, depthWrite: false }),
    );
  }

  colour(by: ColourBy): void {
    this.colour_by = by;
    this.paint();
  }

  private paint(): void {
    const surface = this.parts.surface.getObjectByName("surface") as Mesh | undefined;
    if (!surface || !this.mesh) return;
    const colours = vertex_colours(this.mesh, this.colour_by, this.palette);
    surface.geometry.setAttribute("color", new BufferAttribute(colours, 3));
    this.ask();
  }

  solid(is: boolean): void {
    this.material.uniforms.opacity!.value = is ? 1 : GLASS;
    this.material.depthWrite = is;
    this.material.transparent = !is;
    this.material.needsUpdate = true;
    this.ask();
  }
  cut(is: boolean): void {
    this.is_cut = is;
    this.show_slice(this.slice);
    this.set_theta(this.theta);
  }
  private is_cut = false;
  private readonly under = new Plane(new Vector3(0, 0, -1), 1e9);

  set_theta(theta: number): void {
    this.theta = wrapped(theta);
    this.material.uniforms.cut!.value = this.is_cut ? (this.theta - Math.PI / 2) * this.rise : 1e9;
    this.under.constant = this.is_cut ? (this.theta - Math.PI / 2) * this.rise : 1e9;
    this.parts.slice.position.z = (this.theta - Math.PI / 2) * this.rise;
    this.ask();
  }

  show_slice(slice: Columns | undefined): void {
    this.clear(this.parts.slice);
    this.slice = slice;
    if (!slice) return this.ask();
    const xy = doubles(slice, "xy");
    const start = integers(slice, "start");
    const shell = integers(slice, "shell");
    const ring = (r: number) => {
      const points: Vector2[] = [];
      for (let k = start[r]!; k < start[r + 1]!; ++k)
        points.push(new Vector2(xy[2 * k]! - this.view.x, xy[2 * k + 1]! - this.view.y));
      return points;
    };
    const shapes = new Map<number, Shape>();
    for (let r = 0; r < shell.length; ++r) if (shell[r] === r) shapes.set(r, new Shape(ring(r)));
    for (let r = 0; r < shell.length; ++r)
      if (shell[r]! >= 0 && shell[r] !== r) shapes.get(shell[r]!)?.holes.push(new ShapePath(ring(r)));
    const fill = new Mesh(
      new ShapeGeometry([...shapes.values()]),
      new MeshBasicMaterial({
        color: this.palette.accent,
        transparent: true,
        opacity: this.is_cut ? 0.85 : 0.35,
        side: DoubleSide,
        depthWrite: false,
      }),
    );
    fill.renderOrder = this.is_cut ? 5 : 1;
    const segments = doubles(slice, "segments");
    const kind = bytes(slice, "kind");
    const bend = doubles(slice, "segments.bend");
    const points: number[][] = [[], [], [], []];
    for (let k = 0; k < kind.length; ++k) {
      const ends = [...segments.subarray(4 * k, 4 * k + 4)] as [number, number, number, number];
      const along = along_arc(ends, bend[k] ?? 0).map(([x, y]) => [x - this.view.x, y - this.view.y, 0]);
      for (let j = 1; j < along.length; ++j) points[kind[k]!]!.push(...along[j - 1]!, ...along[j]!);
    }
    const outlines = points.map((of, k) => this.lines(of, k < 3 ? this.palette.accent : this.palette.faint));
    for (const each of outlines) each.renderOrder = 5;
    const [x0, y0, x1, y1] = this.box;
    const floor = new Mesh(
      new PlaneGeometry(x1 - x0, y1 - y0),
      new MeshBasicMaterial({
        color: this.palette.accent,
        transparent: true,
        opacity: 0.13,
        side: DoubleSide,
        depthWrite: false,
      }),
    );
    this.parts.slice.add(floor, fill, ...outlines);
    this.set_theta(this.theta);
  }

  // Show a path, coloured by its clearance as a share of the largest, or by its gears, if these are given.
  show_path(samples: Float64Array | undefined, clearance?: Float64Array, gears?: Gear[]): void {
    this.clear(this.parts.path);
    const parts: { points: Vector3[]; colours: Color[] }[] = [{ points: [], colours: [] }];
    const most = clearance?.reduce((a, b) => Math.max(a, b), 0) || 1;
    const { path, ahead, back, in_place } = this.palette;
    const plain = new Color(path);
    const of_gear = [back, in_place, ahead].map((of) => new Color(of));
    for (let k = 0; samples && k < samples.length; k += 3) {
      const theta = wrapped(samples[k + 2]!);
      const at = this.put(samples[k]!, samples[k + 1]!, theta);
      const { points, colours } = parts.at(-1)!;
      const colour = clearance
        ? on_scale(clearance[k / 3]! / most)
        : gears
          ? of_gear[gears[Math.min(k / 3, gears.length - 1)]! + 1]!
          : plain;
      if (points.length && Math.abs(points.at(-1)!.z - at.z) > Math.PI * this.rise)
        parts.push({ points: [at], colours: [colour] });
      else if (!points.length || points.at(-1)!.distanceTo(at) > 1e-6 * this.view.size) {
        points.push(at);
        colours.push(colour);
      }
    }
    for (const { points, colours } of parts) {
      if (points.length < 2) continue;
      const along = Math.min(3 * points.length, 1500);
      const around = 8;
      const curve = new CatmullRomCurve3(points, false, "centripetal");
      const tube = new TubeGeometry(curve, along, 0.006 * this.view.size, around);
      const each = new Float32Array(3 * (along + 1) * (around + 1));
      const colour_at = (share: number) =>
        // of the length
        colours[Math.ceil(curve.getUtoTmapping(share, share * curve.getLength()) * (colours.length - 1))]!;
      for (let i = 0; i <= along; ++i)
        for (let j = 0; j <= around; ++j) colour_at(i / along).toArray(each, 3 * (i * (around + 1) + j));
      tube.setAttribute("color", new BufferAttribute(each, 3));
      const look = { vertexColors: true };
      const through = new Mesh(
        tube,
        new MeshBasicMaterial({ ...look, transparent: true, opacity: 0.4, depthTest: false }),
      );
      through.renderOrder = 6;
      this.parts.path.add(new Mesh(tube, new MeshBasicMaterial(look)), through);
    }
    this.ask();
  }

  place(at: { x: number; y: number; theta: number }, is_free: boolean): void {
    this.point.visible = true;
    this.point.position.copy(this.put(at.x, at.y, wrapped(at.theta)));
    (this.point.material as MeshBasicMaterial).color.set(is_free ? this.palette.good : this.palette.bad);
    this.ask();
  }
  place_end(k: 0 | 1, at: { x: number; y: number; theta: number } | undefined): void {
    const ball = this.ends[k]!;
    ball.visible = at !== undefined;
    if (at) ball.position.copy(this.put(at.x, at.y, wrapped(at.theta)));
    (ball.material as MeshBasicMaterial).color.set(this.palette.path);
    this.ask();
  }

  repaint(palette: Palette): void {
    this.palette = palette;
    for (const child of this.parts.box.children)
      ((child as LineSegments).material as LineBasicMaterial).color.set(palette.faint);
    const mesh = this.mesh;
    if (mesh) this.show_mesh(mesh);
    this.show_slice(this.slice);
  }

  private clear(group: Group): void {
    for (const child of [...group.children] as (Object3D & { geometry?: BufferGeometry })[]) {
      child.geometry?.dispose();
      group.remove(child);
    }
  }

  private sort(is_coarse: boolean): void {
    const surface = this.parts.surface.getObjectByName("surface") as Mesh | undefined;
    if (!this.sorted || !surface) return;
    surface.geometry.setDrawRange(0, 3 * this.sorted.sort(this.camera.getWorldDirection(new Vector3()), is_coarse));
  }

  ask(): void {
    if (!this.asked) {
      this.asked = true;
      requestAnimationFrame((now) => this.move(now));
    }
    clearTimeout(this.still);
    if (this.is_held) return;
    this.still = window.setTimeout(
      () => requestAnimationFrame(() => this.draw(Math.max(2, devicePixelRatio), false)),
      Math.max(STILL, 2 * this.late),
    );
  }

  // Coarsen while something moves and frames are late.
  private last = 0;
  private late = 0;
  private move(now: number): void {
    const taken = now - this.last;
    this.last = now;
    if (taken < 1000) this.late = 0.7 * this.late + 0.3 * taken;
    this.draw(this.late > 40 ? 0.6 : 1, this.late > 40);
  }

  private draw(ratio: number, is_coarse: boolean): void {
    this.asked = false;
    this.frames += 1;
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    if (this.size !== `${width} ${height} ${ratio}`) this.renderer.setDrawingBufferSize(width, height, ratio);
    this.size = `${width} ${height} ${ratio}`;
    this.parts.surface.children.forEach((child, k) => {
      child.visible = k === 0 || !(is_coarse || this.parts.barrier.children.length);
    });
    this.parts.barrier.children.forEach((child, k) => {
      child.visible = k === 0 || !is_coarse;
    });
    this.camera.aspect = width / height;
    this.camera.fov =
      (2 * Math.atan(Math.tan((16 * Math.PI) / 180) * Math.max(1, (1.02 * height) / width)) * 180) / Math.PI;
    this.camera.updateProjectionMatrix();
    this.sort(is_coarse);
    this.renderer.render(this.scene, this.camera);
    this.host.dataset.frames = String(this.frames);
    for (const { at, element } of this.labels) {
      const p = at.clone().project(this.camera);
      element.style.transform = `translate(-50%,-50%) translate(${((p.x + 1) / 2) * width}px,${((1 - p.y) / 2) * height}px)`;
    }
  }

  pick_middle(): void {
    const { left, top, width, height } = this.renderer.domElement.getBoundingClientRect();
    this.pick({ clientX: left + width / 2, clientY: top + height / 2 });
  }
  private pick(event: { clientX: number; clientY: number }): void {
    const surface = this.parts.surface.getObjectByName("surface") as Mesh | undefined;
    if (!surface || !this.sorted) return;
    const rect = this.renderer.domElement.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(
      new Vector2(
        ((event.clientX - rect.left) / rect.width) * 2 - 1,
        1 - ((event.clientY - rect.top) / rect.height) * 2,
      ),
      this.camera,
    );
    // the mesh has theta for its height: the ray is brought there
    const flat = new BufferGeometry();
    flat.setAttribute("position", surface.geometry.attributes.position!);
    flat.setIndex(new BufferAttribute(this.sorted.triangles, 1));
    ray.ray.origin.z /= this.rise;
    ray.ray.direction.z /= this.rise;
    ray.ray.direction.normalize();
    const probe = new Mesh(flat, new MeshBasicMaterial({ side: DoubleSide }));
    const hit = ray.intersectObject(probe).find((of) => !this.is_cut || of.point.z + Math.PI / 2 <= this.theta);
    if (hit)
      this.on_pick(
        surface.geometry.userData.faces[hit.faceIndex!],
        hit.point.x + this.view.x,
        hit.point.y + this.view.y,
        hit.point.z + Math.PI / 2,
      );
  }

  private key(event: KeyboardEvent): void {
    const turn = 0.12;
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (event.key === "ArrowLeft" || event.key === "ArrowRight")
      offset.applyAxisAngle(this.camera.up, event.key === "ArrowLeft" ? turn : -turn);
    else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
      const to = offset.clone().applyAxisAngle(side, event.key === "ArrowUp" ? -turn : turn);
      if (Math.abs(to.clone().normalize().z) < 0.99) offset.copy(to);
    } else if (event.key === "+" || event.key === "=") offset.multiplyScalar(0.9);
    else if (event.key === "-") offset.multiplyScalar(1 / 0.9);
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.ask();
  }
}
