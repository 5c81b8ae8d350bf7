// A handle on the TCP of a robot: dragging it jogs the robot.

import * as THREE from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Robot } from "./robot";

const SIZE = 0.75;
export type GripMode = "translate" | "rotate";
type Dragged = [robot: Robot, position: [number, number, number], orientation: [number, number, number, number]];
/** Requests a TCP in the robot's world; resolves when it was executed or refused. */
export type Wanted = (...dragged: Dragged) => Promise<void>;

export class Grip {
  private readonly controls: TransformControls;
  private readonly handle = new THREE.Object3D();
  private robot: Robot | null = null;
  private waiting = false;
  private next: Dragged | null = null;
  held = false;

  constructor(camera: THREE.Camera, element: HTMLElement, space: THREE.Scene,
    private readonly wanted: Wanted, changed: () => void, turning: (free: boolean) => void) {
    this.controls = new TransformControls(camera, element);
    this.controls.setSize(SIZE);
    this.controls.setSpace("local");
    space.add(this.handle, this.controls.getHelper());
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("dragging-changed", (event) => {
      this.held = event.value === true;
      turning(!this.held);
      if (!this.held) this.follow();
    });
    this.controls.addEventListener("objectChange", () => void this.ask());
  }

  /** Take a robot's TCP, or none. */
  take(robot: Robot | null, mode: GripMode = "translate"): void {
    this.robot = robot;
    if (!robot) return void this.controls.detach();
    this.controls.setMode(mode);
    this.controls.attach(this.handle);
    this.rest(robot);
  }

  /** Follow the TCP, except while the user drags and until the answer. */
  follow(): void {
    if (this.robot && !this.held && !this.waiting) this.rest(this.robot);
  }

  private rest(robot: Robot): void {
    robot.tcp.getWorldPosition(this.handle.position);
    robot.tcp.getWorldQuaternion(this.handle.quaternion);
    this.handle.updateMatrixWorld();
  }

  /** Its centre, and a point on its x arrow, whose length on the screen is constant. */
  reach(camera: THREE.PerspectiveCamera): [number[], number[]] {
    const middle = this.handle.position.clone();
    // As TransformControls scales itself: 1.9 tan(fov / 2) of the distance, a quarter of it.
    const size = middle.distanceTo(camera.position) * Math.tan((camera.fov * Math.PI) / 360) * 1.9 * SIZE / 4;
    const x = new THREE.Vector3(1, 0, 0).applyQuaternion(this.handle.quaternion);
    return [middle.toArray(), middle.clone().addScaledVector(x, size * 0.4).toArray()];
  }

  /** One request at a time: meanwhile the latest other one is remembered. */
  private async ask(): Promise<void> {
    if (!this.robot) return;
    this.next = this.dragged(this.robot);
    if (this.waiting) return;
    this.waiting = true;
    while (this.next) {
      const latest: Dragged = this.next;
      this.next = null;
      await this.wanted(...latest);
    }
    this.waiting = false;
    this.follow();
  }

  private dragged(robot: Robot): Dragged {
    // It is drawn there with the next picture only.
    this.handle.updateMatrixWorld();
    const place = robot.root.matrixWorld.clone().invert().multiply(this.handle.matrixWorld);
    const position = new THREE.Vector3();
    const turned = new THREE.Quaternion();
    place.decompose(position, turned, new THREE.Vector3());
    return [robot, position.toArray(), [turned.w, turned.x, turned.y, turned.z]];
  }
}
