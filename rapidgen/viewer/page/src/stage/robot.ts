// One robot in the scene: its links, its TCP with a trail, and a ghost at the commanded position.

import * as THREE from "three";
import type { URDFRobot } from "urdf-loader";
import type { SeenRobot, RobotPlace, Pose } from "../messages";
import { Body } from "./body";
import type { Meshes } from "./meshes";
import { nearness, type Palette } from "./palette";
import { Trail } from "./marks";

const AHEAD = 2e-3; // rad or m: the ghost is shown where it differs by more

export class Robot {
  readonly root = new THREE.Group();
  readonly tcp = new THREE.Group();
  readonly object = new THREE.Group();
  /** The link that carries tools. */
  readonly flange: THREE.Object3D;
  readonly trail: Trail;
  readonly ready: Promise<boolean>;
  private readonly body: Body;
  private readonly ghost: Body;
  private readonly shade: THREE.MeshLambertMaterial;
  private readonly meshes: Meshes;
  /** The robot at the first contact, once it is shown. */
  private met: Body | null = null;
  ghosted = true;
  framed = true;
  state: RobotPlace | null = null;

  constructor(readonly group: SeenRobot, private readonly palette: Palette, meshes: Meshes) {
    this.meshes = meshes;
    this.shade = new THREE.MeshLambertMaterial({
      color: palette.accent, transparent: true, opacity: 0.22, depthWrite: false,
      // Behind the robot where their surfaces are in one plane: they would flicker.
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    this.body = new Body(group.urdf, meshes, palette);
    this.ghost = new Body(group.urdf, meshes, palette, this.shade);
    this.ghost.urdf.visible = false;
    this.ready = Promise.all([this.body.ready, this.ghost.ready]).then(([meshes]) => meshes);
    this.trail = new Trail(palette);
    this.tcp.add(axes(0.09, palette));
    this.object.add(axes(0.16, palette));
    this.object.visible = false;
    this.flange = this.body.urdf.links[group.flange] ?? this.body.urdf;
    this.flange.add(this.tcp);
    place(this.root, group.base);
    this.root.add(this.body.urdf, this.ghost.urdf, this.trail.line, this.object);
  }

  /** Hide the links, not their attachments. */
  bare(alone: boolean): void {
    this.body.bare(alone);
  }

  /** New colours. */
  paint(): void {
    this.body.paint();
    this.shade.color.set(this.palette.accent);
    this.trail.paint();
  }

  show(state: RobotPlace): void {
    this.state = state;
    this.set(this.body.urdf, state.joints);
    const ahead = state.commanded.some((value, i) => Math.abs(value - (state.joints[i] ?? 0)) > AHEAD);
    this.ghost.urdf.visible = ahead && this.ghosted;
    if (this.ghost.urdf.visible) this.set(this.ghost.urdf, state.commanded);
    if (state.tool_held) place(this.tcp, state.tool);
    place(this.object, state.work_object);
    // The world's marker is at the robot's.
    this.object.visible = this.framed && !isHome(state.work_object);
    this.warn(state);
    this.root.updateMatrixWorld(true);
    this.trail.add(this.root.worldToLocal(this.tcp.getWorldPosition(new THREE.Vector3())));
  }

  /** Show the robot in red where a contact was; null: hide it. */
  meet(joints: readonly number[] | null): void {
    if (!joints) {
      if (this.met) this.met.urdf.visible = false;
      return;
    }
    if (!this.met) {
      const red = new THREE.MeshLambertMaterial({ color: this.palette.limit, transparent: true, opacity: 0.3, depthWrite: false,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
      this.met = new Body(this.group.urdf, this.meshes, this.palette, red);
      this.root.add(this.met.urdf);
    }
    this.met.urdf.visible = true;
    this.set(this.met.urdf, joints);
  }

  /** For tests: whether the robot at the first contact is shown. */
  get isMet(): boolean {
    return this.met?.urdf.visible === true;
  }

  private set(robot: URDFRobot, values: readonly number[]): void {
    this.group.movable.forEach((name, i) => robot.setJointValue(name, values[i] ?? 0));
  }

  private warn(state: RobotPlace): void {
    let changed = false;
    this.group.axes.forEach((axis, i) => {
      const joint = this.body.urdf.joints[axis.name];
      const link = joint?.children.find((child) => "isURDFLink" in child);
      if (link && this.body.warn(link.name, nearness(axis, state.axes[i] ?? 0))) changed = true;
    });
    if (changed) this.body.paint();
  }

  /** Pose of each link in the world: 16 numbers, column by column. */
  poses(): Record<string, number[]> {
    this.root.updateMatrixWorld(true);
    return Object.fromEntries(
      Object.entries(this.body.urdf.links).map(([name, link]) => [name, link.matrixWorld.toArray()]),
    );
  }

  /** For tests: corners, lowest and highest point of each shape of a link, in the link's frame. */
  parts(): Record<string, [number, number[], number[]][]> {
    return this.body.parts();
  }

  colours(link: string): string[] {
    return this.body.colours(link);
  }

  dispose(): void {
    this.root.traverse((part) => {
      if (part instanceof THREE.Mesh || part instanceof THREE.Line) part.geometry.dispose();
    });
    this.root.removeFromParent();
  }
}

const isHome = ({ position, orientation }: Pose): boolean =>
  Math.hypot(...position) < 1e-9 && Math.abs(orientation[0]) > 1 - 1e-12;

export function place(object: THREE.Object3D, pose: Pose): void {
  const [w, x, y, z] = pose.orientation;
  object.position.set(...(pose.position as [number, number, number]));
  object.quaternion.set(x, y, z, w);
}

/** A frame: x red, y green, z blue. */
export function axes(length: number, palette: Palette): THREE.Object3D {
  const frame = new THREE.Group();
  const bar = new THREE.CylinderGeometry(length * 0.03, length * 0.03, length, 8);
  bar.translate(0, length / 2, 0);
  const turns: [number, number, number][] = [[0, 0, -Math.PI / 2], [0, 0, 0], [Math.PI / 2, 0, 0]];
  turns.forEach((turn, i) => {
    const arm = new THREE.Mesh(bar, new THREE.MeshBasicMaterial({ color: palette.frame[i] }));
    arm.rotation.set(...turn);
    frame.add(arm);
  });
  return frame;
}
