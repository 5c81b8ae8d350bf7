// The scene with the robots, drawn only after changes.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { CollisionBodies, Collisions, Scene, SeenContact, SeenFrame, Positions, SeenTarget, SeenThing } from "../messages";
import { Grip, type GripMode, type Wanted } from "./grip";
import { CollisionMarks } from "./collisions";
import { Labels, TargetMarks, drawnWay } from "./marks";
import { Meshes } from "./meshes";
import { palette } from "./palette";
import { axes, place, Robot } from "./robot";
import { drawnThing } from "./things";

export type ViewName = "fit" | "front" | "side" | "top";
const FROM: Record<ViewName, [number, number, number]> = {
  fit: [1.15, -1.35, 0.85], front: [1, 0, 0.001], side: [0, -1, 0.001], top: [0, -0.001, 1],
};

/** Parts of the scene that can be hidden, and whether they are shown at first. */
export const LAYERS = {
  targets: true, frames: true, ghost: true, trail: true, path: true, objects: true, tools: true, zones: true, shapes: false, distances: true,
};
export type LayerName = keyof typeof LAYERS;

export class Stage {
  readonly element: HTMLCanvasElement;
  readonly robots = new Map<string, Robot>();
  /** Pictures drawn so far, and the time of the state that the last one shows. */
  drawn = { pictures: 0, time: 0 };
  private readonly renderer: THREE.WebGLRenderer;
  private readonly space = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(38, 1, 0.01, 200);
  private readonly controls: OrbitControls;
  private readonly palette = palette();
  private readonly floor = new THREE.Group();
  private readonly way = new THREE.Group();
  readonly things = new THREE.Group();
  private readonly zones = new THREE.Group();
  /** Tools with shapes, each at the flange of its robot. */
  private tools: THREE.Object3D[] = [];
  readonly labels = new Labels();
  private targets: readonly SeenTarget[] = [];
  private frames: readonly SeenFrame[] = [];
  /** Declared tools and work objects. */
  private frameMarks: THREE.Object3D[] = [];
  private marks: TargetMarks[] = [];
  private readonly layers = { ...LAYERS };
  readonly collisions: CollisionMarks;
  private contact: SeenContact | null = null;
  private contactShown = false;
  private readonly grip: Grip;
  /** Executes a drag of the handle. */
  onwanted: Wanted = () => Promise.resolve();
  private readonly meshes = new Meshes((why) => { this.faults.push(why); this.onfault(); });
  /** Deviations from the description; `onfault` is called for a new one. */
  faults: string[] = [];
  onfault = (): void => undefined;
  private touched = false;
  private due = false;
  private time = 0;

  /** Throws without WebGL. */
  constructor() {
    const soft = drawnByCpu();
    this.renderer = new THREE.WebGLRenderer({ antialias: !soft, powerPreference: "low-power" });
    this.renderer.setPixelRatio(soft ? 1 : Math.min(devicePixelRatio, 2));
    this.element = this.renderer.domElement;
    this.element.setAttribute("aria-label", "3D view of the robots");
    this.element.tabIndex = 0;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.element);
    this.controls.listenToKeyEvents(this.element);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => { this.touched = true; });
    this.grip = new Grip(this.camera, this.element, this.space,
      (...wanted) => this.onwanted(...wanted), () => this.draw(), (free) => { this.controls.enabled = free; });
    this.collisions = new CollisionMarks(this.palette);
    const sun = new THREE.DirectionalLight("#ffffff", 1.9);
    sun.position.set(2, -3, 4);
    this.space.add(new THREE.HemisphereLight("#ffffff", "#8a9096", 1.6), sun, this.floor, this.way, this.things, this.zones, this.collisions.root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
    this.paint();
  }

  /** Follow the theme. */
  paint(): void {
    this.palette.renew();
    this.space.background = new THREE.Color(this.palette.ground);
    this.floor.clear();
    const grid = new THREE.GridHelper(6, 24, this.palette.grid, this.palette.grid);
    grid.rotation.x = Math.PI / 2;
    this.floor.add(grid, axes(0.18, this.palette));
    this.collisions.paint();
    for (const robot of this.robots.values()) robot.paint();
    this.aim(this.targets, this.frames);
    this.draw();
  }

  /** Size of the picture, in CSS pixels. */
  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Replace the robots. */
  build(scene: Scene): void {
    for (const robot of this.robots.values()) robot.dispose();
    this.robots.clear();
    this.grip.take(null);
    this.faults = [...scene.faults];
    this.onfault();
    for (const group of scene.groups) {
      const robot = new Robot(group, this.palette, this.meshes);
      this.robots.set(group.name, robot);
      this.space.add(robot.root);
    }
    const coming = this.furnish(scene.things);
    this.look("fit");
    // Meshes arrive later: the view stays if the user has turned it by then.
    this.touched = false;
    void Promise.all([...coming, ...[...this.robots.values()].map((robot) => robot.ready)]).then((came) => {
      if (came.includes(true) && !this.touched) this.look("fit");
      else this.draw();
    });
  }

  /** Replace objects, zones and tools; resolves each to whether a mesh has arrived. */
  private furnish(things: readonly SeenThing[]): Promise<boolean>[] {
    this.things.clear();
    this.zones.clear();
    for (const tool of this.tools) tool.removeFromParent();
    this.tools = [];
    const coming: Promise<boolean>[] = [];
    for (const thing of things) {
      const drawn = drawnThing(thing, this.meshes, this.palette);
      coming.push(drawn.ready);
      if (thing.role === "tool") {
        this.robots.get(thing.robot)?.flange.add(drawn.root);
        this.tools.push(drawn.root);
      } else {
        (thing.role === "object" ? this.things : this.zones).add(drawn.root);
      }
    }
    this.showLayers();
    return coming;
  }

  show(state: Positions): void {
    this.time = state.time;
    [...this.robots.values()].forEach((robot, i) => {
      const own = state.groups[i];
      if (own) robot.show(own);
    });
    this.grip.follow();
    this.draw();
  }

  /** Look at everything from one of the named sides. */
  look(name: ViewName): void {
    const box = new THREE.Box3();
    for (const part of [...[...this.robots.values()].map((robot) => robot.root), ...this.things.children]) {
      // The ground of a cell has no end.
      if (!part.userData["endless"]) box.expandByObject(part);
    }
    if (box.isEmpty()) box.set(new THREE.Vector3(-0.5, -0.5, 0), new THREE.Vector3(0.5, 0.5, 1));
    const ball = box.getBoundingSphere(new THREE.Sphere());
    const narrow = Math.min(1, this.camera.aspect);
    const away = (ball.radius * 1.15) / Math.sin((this.camera.fov * Math.PI) / 360) / narrow;
    this.camera.position.set(...FROM[name]).setLength(away).add(ball.center);
    this.controls.target.copy(ball.center);
    this.controls.update();
    this.draw();
  }

  clearTrails(): void {
    for (const robot of this.robots.values()) robot.trail.clear();
    this.draw();
  }

  /** Draw before the next frame of the screen. */
  draw(): void {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.renderer.render(this.space, this.camera);
      this.labels.draw(this.camera, this.element.clientWidth, this.element.clientHeight);
      this.drawn = { pictures: this.drawn.pictures + 1, time: this.time };
    });
  }

  /** The picture as a PNG. */
  picture(taken: (blob: Blob) => void): void {
    this.renderer.render(this.space, this.camera);
    this.element.toBlob((blob) => { if (blob) taken(blob); });
  }

  /** Draw a path of the TCP, coloured by `warmth` from 0 to 1, with marks at some of its points; empty: none. */
  route(group: string, way: readonly (readonly number[])[], warmth: readonly number[], marks: readonly number[]): void {
    this.way.clear();
    this.robots.get(group)?.root.add(this.way);
    for (const part of drawnWay(way, warmth, marks, this.palette)) this.way.add(part);
    this.draw();
  }

  /** Draw the targets of moves, tools and work objects. */
  aim(targets: readonly SeenTarget[], frames: readonly SeenFrame[]): void {
    this.targets = targets;
    this.frames = frames;
    for (const mark of this.frameMarks) mark.removeFromParent();
    this.frameMarks = [];
    for (const { group, name, kind, pose } of frames) {
      const robot = this.robots.get(group);
      const mark = axes(kind === "tool" ? 0.06 : 0.1, this.palette);
      mark.name = name;
      place(mark, pose);
      (kind === "tool" ? robot?.flange : robot?.root)?.add(mark);
      this.frameMarks.push(mark);
    }
    for (const marks of this.marks) marks.dispose();
    this.marks = [];
    for (const [name, robot] of this.robots) {
      const own = targets.filter((target) => target.group === name);
      if (!own.length) continue;
      const marks = new TargetMarks(own, this.palette);
      robot.root.add(marks.root);
      this.marks.push(marks);
    }
    this.showLayers();
  }

  /** Show or hide a part of the scene. */
  layer(name: LayerName, shown: boolean): void {
    this.layers[name] = shown;
    this.showLayers();
  }

  private showLayers(): void {
    const { layers } = this;
    for (const marks of this.marks) marks.root.visible = layers.targets;
    this.labels.set("targets", layers.targets ? this.marks.flatMap((marks) => marks.names()) : []);
    for (const mark of this.frameMarks) mark.visible = layers.frames;
    this.labels.set("frames", !layers.frames ? [] : this.frameMarks.map((mark) => ({
      text: mark.name, at: () => mark.getWorldPosition(new THREE.Vector3()),
    })));
    this.things.visible = layers.objects;
    this.zones.visible = layers.zones;
    this.collisions.all = layers.shapes;
    this.collisions.distances = layers.distances;
    this.collisions.update();
    this.labels.set("distances", this.collisions.labels());
    this.way.visible = layers.path;
    for (const tool of this.tools) tool.visible = layers.tools;
    for (const robot of this.robots.values()) {
      robot.framed = layers.frames;
      robot.tcp.visible = layers.frames;
      robot.ghosted = layers.ghost;
      robot.trail.line.visible = layers.trail;
      if (robot.state) robot.show(robot.state);
    }
    this.draw();
  }

  /** Replace the bodies of collision checks. */
  collide(bodies: Pick<CollisionBodies, "bodies">): void {
    this.collisions.build(bodies);
    this.showLayers();
  }

  /** Show distances of the bodies. */
  clear(now: Pick<Collisions, "nodes" | "near">): void {
    this.collisions.show(now);
    this.labels.set("distances", this.collisions.labels());
    this.draw();
  }

  /** Take the first contact; null: none. */
  meet(contact: SeenContact | null): void {
    const same = contact?.time === this.contact?.time;
    this.contact = contact;
    if (!same || !contact) this.showContact(this.contactShown);
  }

  /** Show or hide the robots where the first contact was. */
  showContact(shown: boolean): void {
    this.contactShown = shown;
    for (const [name, robot] of this.robots) robot.meet(shown ? this.contact?.joints[name] ?? null : null);
    this.draw();
  }

  /** A handle on a robot's TCP, by which it can be dragged; null: none. */
  hold(name: string | null, mode: GripMode = "translate"): void {
    this.grip.take(name === null ? null : this.robots.get(name) ?? null, mode);
    // Meshes that arrive now do not turn the view during a drag.
    this.touched = true;
    this.draw();
  }

  /** For tests: the targets, and the handle's middle and its x arrow on the picture. */
  aimed(): readonly SeenTarget[] {
    return this.targets;
  }

  around(): Record<string, [number[], number[]]> {
    return Object.fromEntries(this.things.children.map((thing) => {
      const box = new THREE.Box3().setFromObject(thing);
      return [thing.name, [box.min.toArray(), box.max.toArray()]];
    }));
  }

  furnished(): { zones: string[]; tools: string[] } {
    return { zones: this.zones.children.map((zone) => zone.name), tools: this.tools.map((tool) => tool.name) };
  }

  handle(): [number, number, [number, number]] {
    const [middle, arrow] = this.grip.reach(this.camera);
    return [...this.pixel(middle), this.pixel(arrow)];
  }

  /** Show markers alone, without the robots around them. */
  bare(alone: boolean): void {
    for (const robot of this.robots.values()) robot.bare(alone);
    this.draw();
  }

  /** Position of the camera, its target, and its vertical angle (degrees). */
  eye(): { position: number[]; target: number[]; angle: number } {
    const { position, fov } = this.camera;
    return { position: position.toArray(), target: this.controls.target.toArray(), angle: fov };
  }

  /** Position of a point of the world on the picture, in CSS pixels. */
  pixel(point: readonly number[]): [number, number] {
    this.camera.updateMatrixWorld();
    const seen = new THREE.Vector3(...point).project(this.camera);
    const { clientWidth, clientHeight } = this.element;
    return [((seen.x + 1) / 2) * clientWidth, ((1 - seen.y) / 2) * clientHeight];
  }
}

/** True if software renders: antialiasing would cost a third of the frame rate. */
function drawnByCpu(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const about = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = about ? String(gl?.getParameter(about.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
