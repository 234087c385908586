// The body in space: concrete, cracks, bars and rigid bodies at one of the saved moments, deformed by a factor.
import { AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { barColour, crackColour, modeColour, pieceColour } from "./colours.js";

const CONCRETE = new Color("#b4bac2");
const FEATURE_ANGLE = Math.cos((30 * Math.PI) / 180);

/** A colour as the renderer computes with it. */
function linear(srgb) {
  return new Color().setRGB(...srgb, "srgb").toArray();
}

/** A colour map as a table: thousands of triangles ask for colours at every moment. */
class ColourTable {
  constructor(map) {
    this.colours = Array.from({ length: 256 }, (_, i) => linear(map(i / 255)));
  }
  at(share) {
    return this.colours[Math.max(0, Math.min(255, Math.round(255 * share)))];
  }
}

const crackTable = new ColourTable(crackColour), barTable = new ColourTable(barColour);

function dynamic(array, size) {
  const attribute = new BufferAttribute(array, size);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

/** Reference points plus scaled displacements into `out`. */
function deform(out, points, u, factor, count = points.length) {
  for (let i = 0; i < count; ++i) out[i] = points[i] + factor * u[i];
}

/** Mean edge of the triangle whose nine numbers begin at `i`. */
function meanEdge(p, i) {
  const edge = (a, b) => Math.hypot(p[a] - p[b], p[a + 1] - p[b + 1], p[a + 2] - p[b + 2]);
  return (edge(i, i + 3) + edge(i + 3, i + 6) + edge(i + 6, i)) / 3;
}

/** Edges of the undeformed body where it bends sharply, as pairs of its points. */
function featureEdges(points, triangles, count) {
  const key = (p) => `${points[3 * p]},${points[3 * p + 1]},${points[3 * p + 2]}`;
  const number = new Map();
  const position = Array.from({ length: points.length / 3 }, (_, p) => {
    const k = key(p);
    if (!number.has(k)) number.set(k, number.size);
    return number.get(k);
  });
  const a = new Vector3(), b = new Vector3(), c = new Vector3();
  const edges = new Map();
  for (let t = 0; t < count; ++t) {
    const p = triangles.subarray(3 * t, 3 * t + 3);
    a.fromArray(points, 3 * p[0]), b.fromArray(points, 3 * p[1]), c.fromArray(points, 3 * p[2]);
    const normal = b.sub(a).cross(c.sub(a)).normalize().clone();
    for (let k = 0; k < 3; ++k) {
      const [i, j] = [p[k], p[(k + 1) % 3]];
      const [low, high] = position[i] < position[j] ? [position[i], position[j]] : [position[j], position[i]];
      const id = low * number.size + high;
      const known = edges.get(id);
      if (known) known.sharp = known.normal.dot(normal) < FEATURE_ANGLE;
      else edges.set(id, { i, j, normal, sharp: true });
    }
  }
  return [...edges.values()].filter((e) => e.sharp).flatMap((e) => [e.i, e.j]);
}

export class View {
  /** `box`: the element that holds the canvas; `natural`: the frame whose movement gives the factor of deformation.
   * Throws where the browser has no WebGL. */
  constructor(box, numbers, natural) {
    this.box = box;
    this.numbers = numbers;
    this.meta = numbers.meta.scene;
    this.times = numbers.meta.frames;
    this.frame = this.times.length - 1;
    this.options = { scale: 1, concrete: "glass", cracks: "opening", least: 0, bars: true, logarithmic: true };
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true }); // kept: for print and PNG
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    box.append(this.renderer.domElement);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(26, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new AmbientLight("#ffffff", 1.5), this.camera);
    const light = new DirectionalLight("#ffffff", 2.0);
    light.position.set(0.6, 1, 1.2);
    this.camera.add(light);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.measure();
    this.natural = this.naturalScale(natural);
    this.makeBody();
    this.makeCracks();
    this.makeBars();
    this.makeRigid();
    this.look("oblique");
    new ResizeObserver(() => this.resize()).observe(box);
    this.resize();
  }

  measure() {
    const { low, high } = this.meta.body;
    this.centre = new Vector3(...low.map((l, k) => (l + high[k]) / 2));
    this.extent = new Vector3(...low.map((l, k) => high[k] - l));
    this.size = this.extent.length() || 1;
    this.camera.near = this.size / 200;
    this.camera.far = this.size * 40;
  }

  displacement(kind, frame) {
    const values = this.numbers.get(`${kind}/u/${frame}`);
    const scale = this.meta[kind].u[frame];
    const out = new Float32Array(values.length);
    for (let i = 0; i < values.length; ++i) out[i] = values[i] * scale;
    return out;
  }

  /** Sizes of the displacements of a frame [m], ascending. */
  movements(frame) {
    const u = this.displacement("body", frame);
    const sizes = new Float32Array(u.length / 3);
    for (let i = 0; i < sizes.length; ++i) sizes[i] = Math.hypot(u[3 * i], u[3 * i + 1], u[3 * i + 2]);
    return sizes.sort();
  }

  get length() {
    return Math.max(this.extent.x, this.extent.y, this.extent.z);
  }

  /** The next lower 1, 2 or 5 times a power of ten that shows the movement of a frame as 5 % of the body, and pieces in flight within
   * a quarter of it. A frame before anything moves says nothing: then the first later one that does. */
  naturalScale(frame) {
    let sizes = this.movements(frame);
    while (!(sizes.at(-1) > 0) && frame < this.times.length - 1) sizes = this.movements(++frame);
    const usual = sizes[Math.floor(0.99 * (sizes.length - 1))] ?? 0, largest = sizes.at(-1);
    const wanted = usual > 0 ? Math.min((0.05 * this.length) / usual, (0.25 * this.length) / largest) : 1;
    if (!(wanted > 1)) return 1;
    const power = 10 ** Math.floor(Math.log10(wanted));
    return Math.max(...[1, 2, 5].map((m) => m * power).filter((v) => v <= wanted));
  }

  /** The last frame that the natural factor shows as a body: after a collapse it would scatter it over the view. */
  lastInView() {
    for (let frame = this.times.length - 1; frame > 0 && this.natural > 1; --frame) {
      const sizes = this.movements(frame);
      if (sizes[Math.floor(0.99 * (sizes.length - 1))] * this.natural <= 0.3 * this.length) return frame;
    }
    return this.times.length - 1;
  }

  makeBody() {
    const n = this.numbers;
    const body = (this.body = { points: n.get("body/points"), triangles: n.get("body/triangles"), first: n.get("body/first"), group: n.get("body/group"),
      fragment: n.has("body/fragment") ? n.get("body/fragment") : null });
    // Outer faces come with first = 0; sorting by appearance makes the faces shown at a moment the first few.
    const order = Array.from(body.first.keys()).sort((a, b) => body.first[a] - body.first[b]);
    body.order = order;
    const count = order.length;
    // Faces do not share points, so that each is shaded flat and can carry a colour of its own.
    body.corner = new Uint32Array(3 * count);
    order.forEach((t, i) => body.corner.set(body.triangles.subarray(3 * t, 3 * t + 3), 3 * i));
    body.outer = order.findIndex((t) => body.first[t] > 0);
    if (body.outer < 0) body.outer = count;
    const geometry = (body.geometry = new BufferGeometry());
    geometry.setAttribute("position", dynamic(new Float32Array(9 * count), 3));
    geometry.setAttribute("normal", dynamic(new Float32Array(9 * count), 3));
    geometry.setAttribute("color", dynamic(new Float32Array(9 * count), 3));
    this.solid = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide });
    this.glass = new MeshLambertMaterial({ vertexColors: true, transparent: true, opacity: 0.16, depthWrite: false, side: DoubleSide });
    body.mesh = new Mesh(geometry, this.glass);
    body.mesh.frustumCulled = false;

    const outer = new Uint32Array(3 * body.outer);
    outer.set(body.corner.subarray(0, 3 * body.outer));
    body.edges = featureEdges(body.points, outer, body.outer);
    const lines = (body.outline = new BufferGeometry());
    lines.setAttribute("position", dynamic(new Float32Array(3 * body.edges.length), 3));
    body.lines = new LineSegments(lines, new LineBasicMaterial({ color: "#5c6773", transparent: true, opacity: 0.75 }));
    body.lines.frustumCulled = false;
    this.scene.add(body.mesh, body.lines);
  }

  makeCracks() {
    if (!this.meta.cracks) return;
    const n = this.numbers;
    const points = n.get("cracks/points");
    const joints = points.length / 9;
    const geometry = new BufferGeometry(), outline = new BufferGeometry();
    geometry.setAttribute("position", dynamic(new Float32Array(points.length), 3));
    geometry.setAttribute("color", dynamic(new Float32Array(points.length), 3));
    // A crack seen edge-on has no area: its outline shows it.
    const corners = new Uint32Array(6 * joints);
    for (let j = 0; j < joints; ++j) corners.set([0, 1, 1, 2, 2, 0].map((k) => 3 * j + k), 6 * j);
    outline.setAttribute("position", geometry.getAttribute("position"));
    outline.setAttribute("color", geometry.getAttribute("color"));
    outline.setIndex(new BufferAttribute(corners, 1));
    const group = new Group();
    const faces = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    const lines = new LineSegments(outline, new LineBasicMaterial({ vertexColors: true }));
    faces.frustumCulled = lines.frustumCulled = false;
    group.add(faces, lines);
    this.scene.add(group);
    let largest = 0;
    const edge = Float32Array.from({ length: joints }, (_, j) => meanEdge(points, 9 * j));
    for (let f = 0; f < this.times.length; ++f) {
      const opening = n.get(`cracks/opening/${f}`), scale = this.meta.cracks.opening[f];
      for (let j = 0; j < joints; ++j) if (opening[j] * scale <= 0.5 * edge[j]) largest = Math.max(largest, opening[j] * scale);
    }
    this.cracks = { points, edge, group, geometry, outline, mode: n.get("cracks/mode"), failed: n.get("cracks/failed"), shown: n.get("cracks/shown"), largest };
  }

  makeBars() {
    if (!this.meta.bars?.stress) return;
    const n = this.numbers;
    const points = n.get("bars/points");
    if (points.length === 0) return;
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(points));
    geometry.setColors(new Float32Array(points.length));
    const material = new LineMaterial({ vertexColors: true, linewidth: 2.4 });
    const lines = new LineSegments2(geometry, material);
    lines.frustumCulled = false;
    this.scene.add(lines);
    let low = 0, high = 0;
    for (let f = 0; f < this.times.length; ++f) {
      const scale = this.meta.bars.stress[f];
      for (const v of n.get(`bars/stress/${f}`)) {
        if (v * scale < low) low = v * scale;
        if (v * scale > high) high = v * scale;
      }
    }
    this.bars = { points, geometry, material, lines, low, high: Math.max(high, low + 1) };
  }

  makeRigid() {
    if (!this.meta.rigid) return;
    const n = this.numbers;
    const points = n.get("rigid/points"), moves = n.get("rigid/moves");
    this.rigid = [0, 1].map((moving) => {
      const corners = [];
      moves.forEach((m, t) => m === moving && corners.push(3 * t, 3 * t + 1, 3 * t + 2));
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", dynamic(new Float32Array(points), 3));
      geometry.setIndex(corners);
      geometry.computeVertexNormals();
      const material = new MeshLambertMaterial({ color: moving ? "#3b6ea5" : "#d8cfbd", transparent: true, opacity: moving ? 0.55 : 0.5, side: DoubleSide, depthWrite: false });
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      this.scene.add(mesh);
      return { points, geometry };
    });
  }

  /** Shows a moment with the options as they are. */
  show(frame = this.frame) {
    this.frame = Math.max(0, Math.min(frame, this.times.length - 1));
    this.placeBody();
    if (this.cracks) this.placeCracks();
    if (this.bars) this.placeBars();
    if (this.rigid) this.placeRigid();
    this.draw();
  }

  set(options) {
    Object.assign(this.options, options);
    this.show();
  }

  placeBody() {
    const { body, options } = this;
    const u = this.displacement("body", this.frame);
    const moved = new Float32Array(u.length);
    deform(moved, body.points, u, options.scale);
    let count = body.order.findIndex((t) => body.first[t] > this.frame);
    if (count < 0) count = body.order.length;
    if (options.concrete === "glass") count = Math.min(count, body.outer);
    const position = body.geometry.getAttribute("position"), normal = body.geometry.getAttribute("normal"), colour = body.geometry.getAttribute("color");
    const a = new Vector3(), b = new Vector3(), c = new Vector3(), grey = new Color();
    for (let t = 0; t < count; ++t) {
      for (let k = 0; k < 3; ++k) {
        const p = 3 * body.corner[3 * t + k], to = 9 * t + 3 * k;
        (position.array[to] = moved[p]), (position.array[to + 1] = moved[p + 1]), (position.array[to + 2] = moved[p + 2]);
      }
      a.fromArray(position.array, 9 * t), b.fromArray(position.array, 9 * t + 3), c.fromArray(position.array, 9 * t + 6);
      b.sub(a).cross(c.sub(a)).normalize();
      const triangle = body.order[t];
      if (options.concrete === "pieces" && body.fragment) grey.fromArray(linear(pieceColour(body.fragment[triangle])));
      else grey.copy(CONCRETE).multiplyScalar(0.88 ** Math.min(body.group[triangle], 3));
      for (let k = 9 * t; k < 9 * t + 9; k += 3) {
        (normal.array[k] = b.x), (normal.array[k + 1] = b.y), (normal.array[k + 2] = b.z);
        (colour.array[k] = grey.r), (colour.array[k + 1] = grey.g), (colour.array[k + 2] = grey.b);
      }
    }
    for (const attribute of [position, normal, colour]) attribute.needsUpdate = true;
    body.geometry.setDrawRange(0, 3 * count);
    body.mesh.visible = options.concrete !== "hidden";
    body.mesh.material = options.concrete === "glass" ? this.glass : this.solid;
    const outline = body.outline.getAttribute("position");
    body.edges.forEach((p, i) => outline.array.set(moved.subarray(3 * p, 3 * p + 3), 3 * i));
    outline.needsUpdate = true;
    body.lines.visible = options.concrete !== "pieces";
  }

  /** Share of the colour scale for an opening [m]. */
  crackShare(opening) {
    const { least, largest } = this.crackRange();
    if (this.options.logarithmic) return Math.log(Math.max(opening, least) / least) / Math.log(largest / least);
    return opening / largest;
  }

  /** Ends of the colour scale [m]: a hundredth of a millimetre is the least that is worth a colour. */
  crackRange() {
    const largest = Math.max(this.cracks?.largest ?? 0, 1e-4);
    return { least: Math.min(1e-5, largest / 10), largest };
  }

  placeCracks() {
    const { cracks, options, frame } = this;
    cracks.group.visible = options.cracks !== "hidden";
    const shown = cracks.shown[frame];
    const u = this.displacement("cracks", frame);
    const opening = this.numbers.get(`cracks/opening/${frame}`), scale = this.meta.cracks.opening[frame];
    const position = cracks.geometry.getAttribute("position"), colour = cracks.geometry.getAttribute("color");
    const end = this.times[this.times.length - 1] || 1;
    let n = 0;
    const test = new Float32Array(9), testScale = Math.min(options.scale, this.natural); // larger factors stretch everything
    for (let j = 0; j < shown; ++j) {
      const width = opening[j] * scale;
      if (width < options.least || width > 0.5 * cracks.edge[j]) continue; // faces that far apart: room between pieces
      const rgb = options.cracks === "mode" ? linear(modeColour(cracks.mode[j]))
        : options.cracks === "time" ? crackTable.at(1 - (cracks.failed[j] > 0 ? cracks.failed[j] : end) / end)
        : crackTable.at(this.crackShare(width));
      for (let k = 0; k < 9; ++k) test[k] = cracks.points[9 * j + k] + testScale * u[9 * j + k];
      if (meanEdge(test, 0) > 1.5 * cracks.edge[j]) continue; // halfway between two pieces that turn: no crack either
      for (let k = 0; k < 9; ++k) position.array[9 * n + k] = cracks.points[9 * j + k] + options.scale * u[9 * j + k];
      for (let k = 0; k < 9; ++k) colour.array[9 * n + k] = rgb[k % 3];
      ++n;
    }
    position.needsUpdate = colour.needsUpdate = true;
    cracks.geometry.setDrawRange(0, 3 * n);
    cracks.outline.setDrawRange(0, 6 * n);
    this.cracksDrawn = n;
  }

  placeBars() {
    const { bars, options, frame } = this;
    bars.lines.visible = options.bars;
    const u = this.displacement("bars", frame);
    const positions = bars.geometry.getAttribute("instanceStart").data, colours = bars.geometry.getAttribute("instanceColorStart").data;
    deform(positions.array, bars.points, u, options.scale);
    const stress = this.numbers.get(`bars/stress/${frame}`), scale = this.meta.bars.stress[frame];
    stress.forEach((s, i) => {
      const rgb = barTable.at((s * scale - bars.low) / (bars.high - bars.low));
      for (let k = 0; k < 6; ++k) colours.array[6 * i + k] = rgb[k % 3];
    });
    positions.needsUpdate = colours.needsUpdate = true;
  }

  placeRigid() {
    const u = this.displacement("rigid", this.frame);
    for (const { points, geometry } of this.rigid) {
      const position = geometry.getAttribute("position");
      deform(position.array, points, u, this.options.scale);
      position.needsUpdate = true;
    }
  }

  /** Turns the camera: oblique, front (along the thinner level axis), side, top; the whole body in view. */
  look(from) {
    const thin = this.extent.x < this.extent.y ? new Vector3(1, 0, 0) : new Vector3(0, -1, 0);
    const level = new Vector3(0, 0, 1).cross(thin);
    const up = new Vector3(0, 0, 1);
    const towards = {
      front: thin,
      side: level,
      top: up.clone().multiplyScalar(1).addScaledVector(thin, 1e-3),
      oblique: thin.clone().addScaledVector(level, 0.45).addScaledVector(up, 0.4),
    }[from].normalize();
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(towards, this.size);
    this.camera.lookAt(this.centre);
    this.fit(towards);
    this.controls.update();
    this.draw();
  }

  /** Moves the eye along `towards` until the corners of the body's box fill the view. */
  fit(towards) {
    this.camera.updateMatrixWorld();
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0), up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const tall = Math.tan((this.camera.fov * Math.PI) / 360), wide = tall * this.camera.aspect;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new Vector3(...[0, 1, 2].map((k) => (corner & (1 << k) ? 0.5 : -0.5) * this.extent.getComponent(k)));
      const depth = p.dot(towards);
      distance = Math.max(distance, depth + Math.abs(p.dot(right)) / wide, depth + Math.abs(p.dot(up)) / tall);
    }
    this.camera.position.copy(this.centre).addScaledVector(towards, 1.08 * distance);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (!width || !height) return;
    const first = !this.sized;
    this.sized = true;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (first) this.look("oblique");
    this.draw();
  }

  /** Draws soon. `asked` and `drawn` count: the picture is up to date where they agree. */
  draw() {
    this.asked = (this.asked ?? 0) + 1;
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
      this.drawn = this.asked;
    });
  }

  picture() {
    this.renderer.render(this.scene, this.camera);
    return this.renderer.domElement.toDataURL("image/png");
  }

  /** Where the eye is, to come back to it after the page has been read anew. */
  get eye() {
    return { position: this.camera.position.toArray(), target: this.controls.target.toArray() };
  }

  set eye({ position, target }) {
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    this.controls.update();
    this.draw();
  }
}
