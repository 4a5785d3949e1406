// The page of a live view: a picture that grows, and what there is to know beside it.
import * as THREE from "three";
import "./view.css";
import { element } from "../words.js";
import { Connection } from "./connection.js";
import { Scene } from "./scene.js";
import { Status } from "./status.js";

const stage = element("div", { id: "stage" });
const aside = element("aside");
document.body.append(stage, aside);
const status = new Status(aside);
const scene = openScene();
const frames = new Map(); // newest transform by its child
let session;

/** Nothing where the browser has no WebGL: the figures are shown all the same. */
function openScene() {
  try {
    return new Scene(stage);
  } catch {
    stage.append(element("p", { className: "missing", text: "This browser shows no 3D picture (WebGL is missing)." }));
    return undefined;
  }
}

function button(text, act) {
  const made = element("button", { text, type: "button" });
  made.addEventListener("click", act);
  return made;
}

stage.append(element("div", { className: "choices" }, button("oblique", () => scene?.fit("oblique")), button("from above", () => scene?.fit("top"))));

function matrixOf({ position, orientation }) {
  return new THREE.Matrix4().compose(new THREE.Vector3(...position), new THREE.Quaternion(...orientation), new THREE.Vector3(1, 1, 1));
}

/** Where a frame is in the world, by the transforms that lead to it. */
function inWorld(frame) {
  const transform = frames.get(frame);
  return transform ? inWorld(transform.frame).multiply(matrixOf(transform)) : new THREE.Matrix4();
}

const takers = {
  "/tf": ({ transforms }) => transforms.forEach((transform) => frames.set(transform.child, transform)),
  "/map": (map) => {
    scene?.setFrame(inWorld(map.frame));
    scene?.setMap(map);
    document.body.dataset.points = map.count;
  },
  "/path": ({ frame, poses }) => {
    scene?.setFrame(inWorld(frame));
    scene?.setWay(poses.map(({ position }) => position));
  },
  "/scan": (scan) => frames.has("lidar") && scene?.setScan(scan, inWorld("lidar")),
  "/odometry": (pose) => {
    scene?.setFrame(inWorld(pose.frame));
    scene?.setRobot(pose);
    status.takePose(pose);
  },
  "/diagnostics": (diagnostics) => {
    status.takeDiagnostics(diagnostics);
    document.body.dataset.scans = status.scans;
  },
};

new Connection(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`, {
  open(name, id) {
    if (session !== undefined && session !== id) {
      scene?.clear();
      status.clear();
      frames.clear();
    }
    session = id;
    status.connected(name);
  },
  lost: () => status.lost(),
  status: (text) => status.note(text),
  message: (topic, message) => takers[topic](message),
});
