// three.js: one instanced mesh for the outside of the pellets of a shape and one for their inside. Where the cut opens a
// pellet one sees its inside, painted flat, which looks like the cut face of a solid.
import {
  AmbientLight, BackSide, BoxGeometry, BufferAttribute, BufferGeometry, CylinderGeometry, Color, DirectionalLight, DoubleSide, FrontSide,
  HemisphereLight, InstancedBufferAttribute, InstancedMesh, LineBasicMaterial, LineLoop, Matrix4, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, PerspectiveCamera, Plane, Quaternion, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour, isDark } from './theme.js';

const UNIT = 1e3; // the scene is in millimetres: metres are too small for the depth buffer's defaults
const INSIDE = 0.72; // brightness of cut faces

function meshGeometry({ vertices, triangles }) {
  const indexed = new BufferGeometry();
  indexed.setAttribute('position', new BufferAttribute(vertices.map((x) => UNIT * x), 3));
  indexed.setIndex(new BufferAttribute(triangles, 1));
  const flat = indexed.toNonIndexed(); // faces of CAD bodies meet in edges
  flat.computeVertexNormals();
  return flat;
}

function pelletGeometry(shape, many) {
  const facets = many ? 28 : 48;
  if (shape.class === 'sphere') return new SphereGeometry(UNIT * shape.radius_m, facets, facets / 2);
  if (shape.class === 'cylinder') {
    const geometry = new CylinderGeometry(UNIT * shape.radius_m, UNIT * shape.radius_m, 2 * UNIT * shape.half_height_m, facets);
    return geometry.rotateX(Math.PI / 2); // three's cylinders stand along y, ours along z
  }
  return meshGeometry(shape);
}

function matrices(data, members) {
  const { position, rotation, scale } = data.pellets;
  const out = new Float32Array(16 * members.length);
  const [matrix, at, turn, size] = [new Matrix4(), new Vector3(), new Quaternion(), new Vector3()];
  members.forEach((i, k) => {
    at.fromArray(position, 3 * i).multiplyScalar(UNIT);
    turn.fromArray(rotation, 4 * i);
    size.setScalar(scale ? scale[i] : 1);
    matrix.compose(at, turn, size).toArray(out, 16 * k);
  });
  return out;
}

/** All pellets of one shape; paint(colours of all pellets). */
function pelletMeshes(data, index, planes) {
  const members = [];
  data.pellets.shape.forEach((s, i) => { if (s === index) members.push(i); });
  if (members.length === 0) return null;
  const geometry = pelletGeometry(data.shapes[index], members.length > 1500);
  const place = matrices(data, members);
  const make = (material) => {
    const mesh = new InstancedMesh(geometry, material, members.length);
    mesh.instanceMatrix.array.set(place);
    mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * members.length), 3);
    mesh.frustumCulled = false;
    return mesh;
  };
  const outside = make(new MeshLambertMaterial({ side: FrontSide, clippingPlanes: planes }));
  const inside = make(new MeshBasicMaterial({ side: BackSide, clippingPlanes: planes }));
  const one = new Color();
  const paint = (colours) => {
    members.forEach((i, k) => {
      one.setRGB(colours[3 * i], colours[3 * i + 1], colours[3 * i + 2], 'srgb');
      outside.setColorAt(k, one);
      inside.setColorAt(k, one.multiplyScalar(INSIDE * INSIDE));
    });
    outside.instanceColor.needsUpdate = true;
    inside.instanceColor.needsUpdate = true;
  };
  return { meshes: [outside, inside], paint };
}

function bounds(data) {
  const { position, shape, scale, count } = data.pellets;
  const low = [Infinity, Infinity, 0];
  const high = [-Infinity, -Infinity, 0];
  for (let i = 0; i < count; i += 1) {
    const r = data.shapes[shape[i]].bounding_radius_m * (scale ? scale[i] : 1);
    for (let k = 0; k < 3; k += 1) {
      low[k] = Math.min(low[k], position[3 * i + k] - r);
      high[k] = Math.max(high[k], position[3 * i + k] + r);
    }
  }
  return { low: low.map((x) => UNIT * x), high: high.map((x) => UNIT * x) };
}

function ring(radius, z, material) {
  const points = [];
  for (let i = 0; i < 96; i += 1) points.push(new Vector3(radius * Math.cos(i * Math.PI / 48), radius * Math.sin(i * Math.PI / 48), z));
  return new LineLoop(new BufferGeometry().setFromPoints(points), material);
}

function square(x, y, z, material) {
  const points = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([i, j]) => new Vector3(i * x / 2, j * y / 2, z));
  return new LineLoop(new BufferGeometry().setFromPoints(points), material);
}

/** The container as a ghost: its far wall faintly, rims of a tube or box as lines. */
function ghost(data, top) {
  const { container } = data;
  const wall = new MeshBasicMaterial({ transparent: true, opacity: 0.13, side: BackSide, depthWrite: false });
  const line = new LineBasicMaterial({ transparent: true, opacity: 0.7 });
  const parts = [];
  if (container.kind === 'tube') {
    const r = UNIT * container.radius_m;
    const h = Math.min(UNIT * container.height_m || top, 1.12 * top);
    parts.push(new Mesh(new CylinderGeometry(r, r, h, 96, 1, true).rotateX(Math.PI / 2).translate(0, 0, h / 2), wall));
    parts.push(ring(r, 0, line), ring(r, h, line));
  } else if (container.kind === 'box') {
    const [x, y] = [UNIT * container.width_m, UNIT * container.depth_m];
    const h = Math.min(UNIT * container.height_m || top, 1.12 * top);
    parts.push(new Mesh(new BoxGeometry(x, y, h).translate(0, 0, h / 2), wall));
    parts.push(square(x, y, 0, line), square(x, y, h, line));
  } else if (container.vertices && container.vertices.length > 0) {
    wall.side = DoubleSide;
    wall.opacity = 0.1;
    parts.push(new Mesh(meshGeometry(container), wall));
  }
  const tint = () => [wall, line].forEach((material) => material.color.setStyle(colour('ghost')));
  return { parts, tint };
}

function lights(scene, camera) {
  scene.add(new AmbientLight(0xffffff, 0.55), new HemisphereLight(0xffffff, 0x8a8f98, 1.1));
  const lamp = new DirectionalLight(0xffffff, 1.9); // rides with the eye
  lamp.position.set(0.6, 0.9, 1);
  camera.add(lamp, lamp.target);
  lamp.target.position.set(0, 0, -1);
  scene.add(camera);
}

const DIRECTIONS = { corner: [0.62, -1, 0.42], front: [0, -1, 0.02], top: [0, -0.001, 1] };

function turnByKey(event, camera, controls) {
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const zoom = { '+': 0.9, '=': 0.9, '-': 1 / 0.9 }[event.key];
  if (!steps[event.key] && !zoom) return;
  event.preventDefault();
  const arm = camera.position.clone().sub(controls.target);
  if (zoom) arm.multiplyScalar(zoom);
  else {
    const [round, over] = steps[event.key];
    arm.applyAxisAngle(camera.up, round * 0.12);
    const tilt = Math.min(Math.PI - 0.05, Math.max(0.05, arm.angleTo(camera.up) + over * 0.12));
    const side = new Vector3().crossVectors(camera.up, arm).normalize();
    arm.copy(camera.up).multiplyScalar(arm.length()).applyAxisAngle(side, tilt);
  }
  camera.position.copy(controls.target).add(arm);
  controls.update();
}

/** Draws into the canvas; throws where there is no WebGL. */
export function makeScene(canvas, data) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true, powerPreference: 'low-power' });
  renderer.localClippingEnabled = true;
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 1, 1e5);
  camera.up.set(0, 0, 1);
  lights(scene, camera);
  const { low, high } = bounds(data);
  const planes = [];
  const groups = data.shapes.map((_, i) => pelletMeshes(data, i, planes)).filter(Boolean);
  groups.forEach((group) => scene.add(...group.meshes));
  const around = ghost(data, high[2]);
  if (around.parts.length > 0) scene.add(...around.parts);
  const controls = new OrbitControls(camera, canvas);
  const centre = new Vector3().fromArray(low).add(new Vector3().fromArray(high)).multiplyScalar(0.5);
  const size = [0, 1, 2].map((k) => high[k] - low[k]);

  let asked = 0;
  const render = () => { asked = 0; renderer.render(scene, camera); };
  const ask = () => { if (!asked) asked = requestAnimationFrame(render); };
  controls.addEventListener('change', ask);
  canvas.addEventListener('keydown', (event) => turnByKey(event, camera, controls));

  function resize() {
    const { clientWidth: width, clientHeight: height } = canvas.parentElement || canvas;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  }
  let view = 'corner';
  let moved = false; // by the reader: then a new size of the window leaves the view alone
  function look(name) {
    view = name;
    moved = false;
    const direction = new Vector3().fromArray(DIRECTIONS[name]).normalize();
    const tall = name === 'top' ? Math.hypot(size[0], size[1]) : Math.hypot(size[2], 0.6 * Math.hypot(size[0], size[1]));
    const wide = Math.hypot(size[0], size[1]) / camera.aspect;
    const distance = 0.57 * Math.max(tall, wide) / Math.tan(camera.fov * Math.PI / 360) + 0.3 * size[0];
    controls.target.copy(centre);
    camera.position.copy(centre).addScaledVector(direction, distance);
    camera.near = distance / 100;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    controls.update();
    ask();
  }
  controls.addEventListener('start', () => { moved = true; });
  canvas.addEventListener('keydown', () => { moved = true; });
  return {
    look,
    draw() {
      resize();
      scene.background = new Color().setStyle(colour('scene'));
      around.tint();
      renderer.toneMappingExposure = isDark() ? 0.95 : 1;
      if (!moved) look(view);
      render();
    },
    colours(values) { groups.forEach((group) => group.paint(values)); ask(); },
    container: around.parts.length === 0 ? null : (visible) => { around.parts.forEach((part) => { part.visible = visible; }); ask(); },
    /** Takes away what lies beyond `fraction` of the bed along the axis; gives the place in metres. */
    cut(axis, fraction) {
      planes.length = 0;
      const k = 'xyz'.indexOf(axis);
      if (k < 0) { ask(); return null; }
      const at = low[k] + fraction * size[k];
      const normal = new Vector3().setComponent(k, k === 1 ? 1 : -1); // the viewer stands at negative y
      planes.push(new Plane(normal, k === 1 ? -at : at));
      ask();
      return at / UNIT;
    },
  };
}
