// What is seen: the map as it grows, the scan in it, the way and the robot. Drawn when something changed.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { frame, kFieldOfView } from "../map/camera.js";
import { gridBox, makeGrid } from "../map/grid.js";
import { Robot } from "../map/paths.js";
import { rampTexture } from "../map/ramps.js";
import { color, onThemeChange } from "../theme.js";

const kVertex = `
uniform float size;
uniform vec2 heights;
uniform sampler2D ramp;
varying vec3 shade;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * at;
  gl_PointSize = clamp(size / -at.z, 1.5, 10.0);
  float share = (position.z - heights.x) / (heights.y - heights.x);
  shade = texture2D(ramp, vec2(clamp(share, 0.002, 0.998), 0.5)).rgb;
}`;
const kFragment = "varying vec3 shade;\nvoid main() { gl_FragColor = vec4(shade, 1.0); }";
const kPointSize = 0.09; // [m] that a point covers
const kInside = 0.98; // of the points lie in the box that the view is fitted to
const kRobot = 0.03; // of the longer side of the map
const kMostWay = 20000; // poses of the way that are drawn

function plain(name) {
  return new THREE.Color().setStyle(color(name), THREE.LinearSRGBColorSpace);
}

function cloudOf(material) {
  const cloud = new THREE.Points(new THREE.BufferGeometry(), material);
  cloud.frustumCulled = false;
  return cloud;
}

function fill(object, positions) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(positions, 3));
}

/** The box of nearly all of the points. */
function boxOf(positions) {
  const stride = 3 * Math.max(1, Math.floor(positions.length / 3 / 10000));
  const sides = [[], [], []];
  for (let i = 0; i < positions.length; i += stride) sides.forEach((side, axis) => side.push(positions[i + axis]));
  sides.forEach((side) => side.sort((a, b) => a - b));
  const corner = (share) => new THREE.Vector3(...sides.map((side) => side[Math.floor(share * (side.length - 1))]));
  return new THREE.Box3(corner((1 - kInside) / 2), corner((1 + kInside) / 2));
}

export class Scene {
  constructor(stage) {
    this.stage = stage;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours stand as they are given
    stage.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.05, 10000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.ask());
    this.controls.addEventListener("start", () => (this.fitted = false)); // who turns the view keeps it
    this.fitted = true;
    this.from = "oblique";
    this.box = new THREE.Box3(new THREE.Vector3(-5, -5, -1), new THREE.Vector3(5, 5, 2));
    this.build();
    this.restyle();
    onThemeChange(() => this.restyle());
    new ResizeObserver(() => this.resize()).observe(stage);
    this.resize();
  }

  build() {
    const uniforms = { size: { value: 1 }, heights: { value: [-1, 2] }, ramp: { value: rampTexture("height") } };
    this.material = new THREE.ShaderMaterial({ vertexShader: kVertex, fragmentShader: kFragment, uniforms });
    this.map = cloudOf(this.material);
    this.scan = cloudOf(new THREE.PointsMaterial({ size: 2.5, sizeAttenuation: false }));
    this.scan.matrixAutoUpdate = false;
    this.way = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false, transparent: true }));
    this.way.frustumCulled = false;
    this.way.renderOrder = 1;
    this.points = []; // of the way
    this.robot = new Robot({}, 1);
    this.robot.object.visible = false;
    this.grid = new THREE.Group();
    this.mapped = new THREE.Group(); // what is given in the frame of odometry, while loops are being closed
    this.mapped.matrixAutoUpdate = false;
    this.mapped.add(this.map, this.way, this.robot.object);
    this.scene.add(this.grid, this.mapped, this.scan);
  }

  restyle() {
    this.renderer.setClearColor(plain("scene"));
    this.scan.material.color.copy(plain("earlier"));
    this.way.material.color.copy(plain("way"));
    this.robot.setColor(plain("way"), plain("scene"));
    this.regrid();
    this.ask();
  }

  regrid() {
    this.grid.clear();
    this.grid.add(makeGrid(this.box, plain("scene-grid"), color("faint")));
  }

  /** Nothing is known any more: another run begins. */
  clear() {
    for (const cloud of [this.map, this.scan]) fill(cloud, new Float32Array(0));
    this.setWay([]);
    this.robot.object.visible = false;
    this.fitted = true;
    this.ask();
  }

  /** Where the frame is that map, way and robot are given in. */
  setFrame(T_world_frame) {
    this.mapped.matrix.copy(T_world_frame);
    this.mapped.matrixWorldNeedsUpdate = true;
    this.ask();
  }

  setMap({ positions }) {
    fill(this.map, positions);
    if (positions.length === 0) return;
    this.box = boxOf(positions);
    this.material.uniforms.heights.value = [this.box.min.z, Math.max(this.box.max.z, this.box.min.z + 1)];
    this.regrid();
    const size = this.box.getSize(new THREE.Vector3());
    this.robot.object.scale.setScalar(Math.max(0.4, kRobot * Math.max(size.x, size.y)));
    if (this.fitted) this.look(this.from);
    this.ask();
  }

  setScan({ positions }, T_world_lidar) {
    fill(this.scan, positions);
    this.scan.matrix.copy(T_world_lidar);
    this.ask();
  }

  setWay(points) {
    this.points = points;
    fill(this.way, new Float32Array(points.flat()));
    this.ask();
  }

  setRobot({ position, orientation }) {
    this.robot.object.visible = true;
    this.robot.object.position.fromArray(position);
    this.robot.object.quaternion.fromArray(orientation);
    this.setWay([...this.points.slice(-kMostWay), position]);
  }

  /** Looks at all of it: "oblique" or from the "top". */
  look(from) {
    this.from = from;
    const size = this.box.getSize(new THREE.Vector3());
    const back = size.x >= size.y ? new THREE.Vector3(0, -1, 0) : new THREE.Vector3(1, 0, 0);
    const direction = (from === "top" ? back.multiplyScalar(0.001).setZ(1) : back.setZ(0.9)).normalize();
    this.controls.target.copy(frame(this.camera, gridBox(this.box), direction));
    this.controls.update();
    this.ask();
  }

  fit(from) {
    this.fitted = true;
    this.look(from);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.material.uniforms.size.value = (kPointSize * height * this.renderer.getPixelRatio()) / (2 * Math.tan((kFieldOfView * Math.PI) / 360));
    this.look(this.from);
  }

  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
