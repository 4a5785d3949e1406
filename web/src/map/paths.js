// Ways through the map, keyframes, loop closures and the robot.
import * as THREE from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { lastNotAbove } from "../data.js";

function positions(path) {
  const flat = new Float32Array(3 * path.t.length);
  for (let i = 0; i < path.t.length; ++i) flat.set([path.x[i], path.y[i], path.z[i]], 3 * i);
  return flat;
}

function fatLine(flat, options) {
  const geometry = new LineGeometry();
  geometry.setPositions(flat);
  const line = new Line2(geometry, new LineMaterial({ depthTest: false, transparent: true, ...options }));
  line.frustumCulled = false;
  line.renderOrder = 1; // seen through walls and ceilings
  return line;
}

/** A way, `width` [px] wide: faint as a whole, bright up to the moment shown. */
export class Way {
  constructor(path, width) {
    this.path = path;
    const flat = positions(path);
    this.object = new THREE.Group();
    if (path.t.length < 2) return;
    this.past = fatLine(flat, { linewidth: width });
    this.past.renderOrder = path.truth ? 1.4 : 1.5; // the truth lies below what is held against it
    this.whole = fatLine(flat, { linewidth: 1 });
    this.object.add(this.whole, this.past);
  }

  /** `color`, and half way to that of the `ground` as a whole. */
  setColor(color, ground) {
    if (!this.past) return;
    this.past.material.color.copy(color);
    this.whole.material.color.copy(color).lerp(ground, 0.5);
  }

  showUntil(time) {
    if (this.past) this.past.geometry.instanceCount = lastNotAbove(this.path.t, time);
  }
}

/** Where the sensor is: an arrow along its x axis. */
export class Robot {
  constructor(path, size) {
    this.path = path;
    const shape = new THREE.Shape([[1, 0], [-0.6, 0.62], [-0.25, 0], [-0.6, -0.62]].map(([x, y]) => new THREE.Vector2(size * x, size * y)));
    const geometry = new THREE.ExtrudeGeometry(shape, { depth: 0.25 * size, bevelEnabled: false });
    this.object = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }));
    this.edges = new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({ depthTest: false, transparent: true }));
    this.object.add(this.edges);
    this.object.renderOrder = 3;
    this.edges.renderOrder = 4;
  }

  setColor(color, edge) {
    this.object.material.color.set(color);
    this.edges.material.color.set(edge);
  }

  /** Moves to the pose at `time`; returns its number. */
  moveTo(time) {
    const path = this.path;
    const i = lastNotAbove(path.t, time);
    this.object.position.set(path.x[i], path.y[i], path.z[i]);
    this.object.quaternion.set(path.qx[i], path.qy[i], path.qz[i], path.qw[i]);
    return i;
  }
}

export function keyframeDots(path, keyframes) {
  const flat = new Float32Array(keyframes.flatMap((i) => [path.x[i], path.y[i], path.z[i]]));
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(flat, 3));
  const dots = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 4, sizeAttenuation: false, depthTest: false, transparent: true }));
  dots.renderOrder = 2;
  return dots;
}

export function closureLines(path, closures) {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(closures.flat().flatMap((i) => [path.x[i], path.y[i], path.z[i]]));
  const lines = new LineSegments2(geometry, new LineMaterial({ linewidth: 2, depthTest: false, transparent: true }));
  lines.frustumCulled = false;
  lines.renderOrder = 2;
  return lines;
}
