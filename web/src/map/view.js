// The 3D view: the map over its grid, the ways, the robot at the moment that the timeline shows; turned and zoomed with
// the mouse. It draws only when something changed; what is added to a picture that stands is drawn into it.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { color, onThemeChange } from "../theme.js";
import { element } from "../words.js";
import { boxOfMap, boxOfWays } from "./box.js";
import { frame, kFieldOfView } from "./camera.js";
import { gridBox, makeGrid } from "./grid.js";
import { Pace } from "./pace.js";
import { Panel } from "./panel.js";
import { closureLines, keyframeDots, Robot, Way } from "./paths.js";
import { MapPoints, unpacked } from "./points.js";
import { modes, rampTexture } from "./ramps.js";

const kPointSize = 0.07; // [m] that a point covers

export class MapView {
  /** The view in `place`, its first picture drawn; where there is no WebGL `place` stays as it is and nothing is returned. */
  static async open(place, map, timeline) {
    const unpacking = map.first && unpacked(map, map.first); // beside the start of WebGL
    const canvas = element("canvas", { tabIndex: 0 });
    const context = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true }); // what is drawn stays, to be added to
    if (!context) return undefined;
    const points = new MapPoints(map, await unpacking);
    if (map.moving) Object.assign(map.moving, { paths: map.paths });
    points.moved = new MapPoints(map.moving ?? map, map.moving && (await unpacked(map.moving, map.moving.first)));
    const view = new MapView(place, map, points, timeline, new THREE.WebGLRenderer({ canvas, context }));
    await new Promise((resume) => requestAnimationFrame(resume));
    await view.finished();
    return view;
  }

  constructor(place, map, points, timeline, renderer) {
    Object.assign(this, { map, points, timeline, renderer });
    this.panel = new Panel(place, map, this);
    this.boxes = { map: boxOfMap(map, points), ways: boxOfWays(map) };
    this.renderer.autoClear = false;
    this.renderer.debug.checkShaderErrors = false; // asking waits for the graphics card
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours stand as they are given
    this.scene = new THREE.Scene();
    this.ground = new THREE.Scene(); // below all that is added to a picture
    this.camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.05, 10000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.panel.canvas);
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = false;
    this.pace = new Pace(points, (anew, drawn) => this.render(anew, drawn));
    this.fill();
    this.restyle();
    this.listen();
    this.look("oblique");
    this.show(timeline.time);
  }

  fill() {
    const [estimate, ...others] = this.map.paths;
    const size = this.boxes.map.getSize(new THREE.Vector3());
    this.ways = new THREE.Group();
    this.earlier = new THREE.Group();
    this.truths = new THREE.Group();
    this.main = new Way(estimate, 3);
    this.others = others.map((path) => new Way(path, path.truth ? 5 : 2));
    this.ways.add(this.main.object);
    this.others.forEach((way) => (way.path.truth ? this.truths : this.earlier).add(way.object));
    this.robot = new Robot(estimate, Math.max(0.4, 0.018 * Math.max(size.x, size.y)));
    this.keyframes = keyframeDots(estimate, this.map.keyframes);
    this.closures = closureLines(estimate, this.map.closures);
    this.grid = new THREE.Group();
    this.cloud = this.points.object;
    this.moved = this.points.moved.object;
    this.moved.visible = false;
    this.points.moved.inRed();
    this.points.moved.draw(0, this.points.moved.count);
    this.scene.add(this.cloud, this.moved, this.ways, this.earlier, this.truths, this.robot.object, this.keyframes, this.closures);
    this.ground.add(this.grid);
    this.robot.object.visible = estimate.t.length > 0;
    this.colorBy("height");
  }

  /** Adds another layer of the map. */
  async add(layer) {
    this.points.add(await unpacked(this.map, layer));
    this.pace.more();
  }

  listen() {
    this.controls.addEventListener("change", () => this.pace.moving());
    this.timeline.onTime((time) => this.show(time));
    onThemeChange(() => this.restyle());
    new ResizeObserver(() => this.resize()).observe(this.panel.stage);
    this.resize();
  }

  /** Takes on the colours of the page. */
  restyle() {
    const plain = (name) => new THREE.Color().setStyle(color(name), THREE.LinearSRGBColorSpace);
    const ground = plain("scene");
    this.renderer.setClearColor(ground);
    this.regrid();
    this.main.setColor(plain("way"), ground);
    this.others.forEach((way) => way.setColor(plain(way.path.truth ? "truth" : "earlier"), ground));
    this.robot.setColor(plain("way"), ground);
    this.keyframes.material.color.copy(plain("keyframe"));
    this.closures.material.color.copy(plain("closure"));
    this.pace.still();
  }

  /** What the view is fitted to: the map, or the ways where that is hidden. */
  get box() {
    return this.cloud.visible ? this.boxes.map : this.boxes.ways;
  }

  regrid() {
    const line = new THREE.Color().setStyle(color("scene-grid"), THREE.LinearSRGBColorSpace);
    this.grid.clear();
    this.grid.add(makeGrid(this.box, line, color("faint")));
  }

  colorBy(mode) {
    this.points.colorBy(modes.indexOf(mode), rampTexture(mode));
    this.panel.explain(mode, this.points.heights);
    this.pace.still();
  }

  /** Hides what lies above `height` [m]: ceilings, trees. */
  cutAbove(height) {
    for (const points of [this.points, this.points.moved]) points.cutAbove(height);
    this.pace.moving();
  }

  toggle(part, visible) {
    this[part].visible = visible;
    if (part === "cloud") this.regrid();
    this.pace.still();
  }

  /** Looks at all of it: "oblique" or from the "top". */
  look(from) {
    const size = this.box.getSize(new THREE.Vector3());
    const back = size.x >= size.y ? new THREE.Vector3(0, -1, 0) : new THREE.Vector3(1, 0, 0);
    const direction = (from === "top" ? back.multiplyScalar(0.001).setZ(1) : back.setZ(0.9)).normalize();
    this.controls.target.copy(frame(this.camera, gridBox(this.box), direction));
    this.controls.update();
    this.pace.still();
  }

  show(time) {
    const share = this.timeline.duration ? time / this.timeline.duration : 1;
    for (const points of [this.points, this.points.moved]) points.showUntil(share);
    for (const way of [this.main, ...this.others]) way.showUntil(time);
    if (this.map.paths[0].t.length) this.panel.say(time, this.robot.moveTo(time));
    this.pace.moving();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.panel.stage;
    if (!width || !height || (width === this.width && height === this.height)) return;
    Object.assign(this, { width, height });
    this.renderer.setDrawingBufferSize(width, height, Math.min(devicePixelRatio, 2));
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const pixels = (height * this.renderer.getPixelRatio()) / (2 * Math.tan((kFieldOfView * Math.PI) / 360));
    for (const points of [this.points, this.points.moved]) points.setSize(kPointSize * pixels);
    this.pace.still();
  }

  render(anew, drawn) {
    if (anew) {
      this.renderer.clear();
      this.renderer.render(this.ground, this.camera);
    }
    this.renderer.render(this.scene, this.camera);
    this.panel.stage.dataset.drawn = drawn;
  }

  /** Waits until the graphics card has drawn what it was given. */
  async finished() {
    const gl = this.renderer.getContext();
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((resume) => setTimeout(resume, 5));
    gl.deleteSync(fence);
  }
}
