// One robot in space: its links, its TCP with a trail, and the ghost that is ahead of it.

import * as THREE from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";
import type { SeenRobot, RobotPlace, Pose } from "../messages";
import { nearness } from "./nearness";
import type { Palette } from "./palette";
import { Trail } from "./trail";

const AHEAD = 2e-3; // rad or m: the ghost is shown where it differs by more

export class Robot {
  readonly root = new THREE.Group();
  readonly tcp = new THREE.Group();
  readonly trail: Trail;
  private readonly body: URDFRobot;
  private readonly ghost: URDFRobot;
  private readonly housings = new Map<string, THREE.MeshLambertMaterial>();
  private readonly skin: THREE.MeshLambertMaterial;
  private readonly shade: THREE.MeshLambertMaterial;
  ghosted = true;
  state: RobotPlace | null = null;

  constructor(
    readonly group: SeenRobot,
    private readonly palette: Palette,
    changed: () => void,
  ) {
    this.skin = new THREE.MeshLambertMaterial({ color: palette.body });
    this.shade = new THREE.MeshLambertMaterial({
      color: palette.accent, transparent: true, opacity: 0.22, depthWrite: false,
    });
    this.body = this.described(changed);
    this.ghost = this.described(changed);
    this.ghost.traverse((part) => {
      if (part instanceof THREE.Mesh) part.material = this.shade;
    });
    this.ghost.visible = false;
    this.dress();
    this.trail = new Trail(palette);
    this.tcp.add(axes(0.09, palette));
    const flange = this.body.links[group.flange] ?? this.body;
    flange.add(this.tcp);
    place(this.root, group.base);
    this.root.add(this.body, this.ghost, this.trail.line);
  }

  private described(changed: () => void): URDFRobot {
    const manager = new THREE.LoadingManager(changed);
    const loader = new URDFLoader(manager);
    loader.parseCollision = false;
    return loader.parse(this.group.urdf);
  }

  /** Own materials for what has none of its own; a housing is coloured by its axis' limits. */
  private dress(): void {
    for (const [name, link] of Object.entries(this.body.links)) {
      const housing = new THREE.MeshLambertMaterial({ color: this.palette.housing });
      for (const part of own(link)) {
        const plain = (part.material as THREE.Material).name;
        if (plain !== "body" && plain !== "housing") continue;
        part.material = plain === "body" ? this.skin : housing;
      }
      this.housings.set(name, housing);
    }
  }

  /** Hide the links, not what they carry. */
  bare(alone: boolean): void {
    for (const material of [this.skin, ...this.housings.values()]) material.visible = !alone;
  }

  /** New colours. */
  paint(): void {
    this.skin.color.set(this.palette.body);
    this.shade.color.set(this.palette.accent);
    this.trail.paint();
    if (this.state) this.warn(this.state);
  }

  show(state: RobotPlace): void {
    this.state = state;
    this.set(this.body, state.joints);
    const ahead = state.commanded.some((value, i) => Math.abs(value - (state.joints[i] ?? 0)) > AHEAD);
    this.ghost.visible = ahead && this.ghosted;
    if (this.ghost.visible) this.set(this.ghost, state.commanded);
    if (state.tool_held) place(this.tcp, state.tool);
    this.warn(state);
    this.root.updateMatrixWorld(true);
    this.trail.add(this.root.worldToLocal(this.tcp.getWorldPosition(new THREE.Vector3())));
  }

  private set(robot: URDFRobot, values: readonly number[]): void {
    this.group.movable.forEach((name, i) => robot.setJointValue(name, values[i] ?? 0));
  }

  private warn(state: RobotPlace): void {
    this.group.axes.forEach((axis, i) => {
      const joint = this.body.joints[axis.name];
      const link = joint?.children.find((child) => "isURDFLink" in child);
      const housing = link && this.housings.get(link.name);
      housing?.color.set(this.palette[nearness(axis, state.axes[i] ?? 0)]);
    });
  }

  /** Pose of each link in the world: 16 numbers, column by column. */
  poses(): Record<string, number[]> {
    this.root.updateMatrixWorld(true);
    return Object.fromEntries(
      Object.entries(this.body.links).map(([name, link]) => [name, link.matrixWorld.toArray()]),
    );
  }

  dispose(): void {
    this.root.traverse((part) => {
      if (part instanceof THREE.Mesh || part instanceof THREE.Line) part.geometry.dispose();
    });
    this.root.removeFromParent();
  }
}

function* own(link: THREE.Object3D): Generator<THREE.Mesh> {
  for (const child of link.children) {
    if ("isURDFJoint" in child || "isURDFLink" in child) continue;
    if (child instanceof THREE.Mesh) yield child;
    yield* own(child);
  }
}

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
