// Jogging: each axis within its limits, and the TCP in a frame, by steps and by numbers. Read only: axes and TCP.

import * as THREE from "three";
import { Choice, h, say, Field } from "../dom";
import type { Axis, Copy, Jog, JogBy, JogTo, Pose, SeenRobot, RobotPlace } from "../messages";
import type { MakePanel, View } from "../panel";
import { nearness } from "../stage/palette";

const FORMS: readonly (readonly [Copy["form"], string])[] =
  [["jointtarget", "jointtarget"], ["robtarget", "robtarget"], ["python", "Python"]];
const STEPS = [["0.01", "0.01"], ["0.1", "0.1"], ["1", "1"], ["5", "5"], ["10", "10"]] as const;
const FRAMES = [["base", "Base"], ["tool", "Tool"], ["work_object", "Work object"]] as const;
type Step = (typeof STEPS)[number][0];
type Frame = JogBy["frame"];
const FORWARD = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 } as const;
const FAR = ["Home", "End", "PageUp", "PageDown"]; // keys that would move a slider by more than a step
const DEGREES = 180 / Math.PI;

export const axesPanel: MakePanel = (view) => {
  const element = h("div", { class: "panel" });
  let robots: RobotAxes[] = [];
  let step: Step = "1";
  const steps = new Choice<Step>("Step in ° or mm", STEPS, (value) => steps.show(step = value));
  steps.show(step);
  const why = h("span", {});
  const stop = h("button", { type: "button", onclick: () => view.order({ do: "act", action: "stop" }) }, "Stop program");
  const note = h("div", { class: "row note commands" }, why, stop);
  view.link.on("scene", (scene) => {
    robots = scene.groups.map((group) => new RobotAxes(group, scene.may_command, view, () => Number(step)));
    const bar = h("div", { class: "row commands" }, h("span", { class: "label" }, "Step"), steps.element, h("span", { class: "label" }, "° or mm"));
    element.replaceChildren(note, bar, ...robots.map((robot) => robot.element));
    if (!robots.length) element.replaceChildren(h("p", { class: "soft" }, "No robot is configured."));
  });
  view.link.on("positions", (state) => {
    const blocked = state.groups[0]?.blocked ?? "";
    stop.hidden = !blocked;
    say(why, blocked ? "A program controls the robot." : "Each step, slider and number moves the robot at once.");
    robots.forEach((robot, i) => robot.show(state.groups[i]));
  });
  return { id: "axes", title: "Axes", titleOf: (kind) => (kind === "simulation" ? "Jog" : undefined), element };
};

class RobotAxes {
  readonly element: HTMLElement;
  private readonly rows: AxisRow[];
  private readonly pose = h("output", { class: "pose" });
  private readonly place: Field[];
  private readonly frames: Choice<Frame>;
  private frame: Frame = "base";
  private state: RobotPlace | undefined;

  constructor(private readonly group: SeenRobot, commands: boolean, private readonly view: View, private readonly step: () => number) {
    this.rows = group.axes.map((axis, i) => new AxisRow(axis, commands, step, (value, relative) => this.jog(i, value, relative)));
    const buttons = FORMS.map(([form, name]) =>
      h("button", { type: "button", onclick: () => void this.copy(form, name) }, name));
    this.frames = new Choice<Frame>(`Frame of ${group.name}`, FRAMES, (frame) => this.choose(frame));
    const lines = ["x", "y", "z"];
    this.place = [...lines.map((name) => `TCP ${name} of ${group.name} in mm`), ...lines.map((name) => `TCP rotation about ${name} of ${group.name} in °`)]
      .map((label, i) => new Field({ label, commit: (value) => this.jogTo(i, value), step: (direction) => void this.jogBy(i, direction) }));
    const cartesian = h("div", { class: "place" }, ...this.place.map((field, i) => h("div", { class: "cartesian" },
      h("span", {}, i < 3 ? lines[i]?.toUpperCase() ?? "" : `R${lines[i - 3]}`),
      ...([-1, 1] as const).map((way) => h("button", { type: "button", "aria-label": `${i < 3 ? "" : "R"}${lines[i % 3]} ${way < 0 ? "−" : "+"} of ${group.name}`,
        onclick: () => void this.jogBy(i, way) }, way < 0 ? "−" : "+")),
      h("span", { class: "figure" }, field.element, i < 3 ? "mm" : "°"))));
    this.element = h("section", {}, h("h2", {}, `${group.name} · ${group.task}`),
      h("div", { class: "axes" }, ...this.rows.map((row) => row.element)),
      h("h2", { hidden: !group.has_geometry }, "TCP"),
      h("div", { class: "commands", hidden: !commands || !group.has_geometry }, this.frames.element, cartesian),
      this.pose, h("div", { class: "row" }, h("span", { class: "label" }, "Copy as"), ...buttons));
    this.pose.hidden = commands;
    this.choose("base");
  }

  show(state: RobotPlace | undefined): void {
    if (!state) return;
    this.state = state;
    this.rows.forEach((row, i) => row.show(state.axes[i] ?? 0));
    if (!state.tcp) return;
    const [x, y, z] = state.tcp.position.map((value) => (value * 1000).toFixed(1));
    say(this.pose, `x ${x}  y ${y}  z ${z} mm`);
    const figures = inFrame(state, this.frame);
    this.place.forEach((field, i) => field.show(this.frame === "tool" ? "" : (figures[i] ?? 0).toFixed(i < 3 ? 1 : 2)));
  }

  private choose(frame: Frame): void {
    this.frame = frame;
    this.frames.show(frame);
    // In its own frame the TCP is always at 0: a typed number is a step.
    for (const field of this.place) field.element.placeholder = frame === "tool" ? "step" : "";
    this.show(this.state);
  }

  // An axis without a value keeps its position at the arrival of the order, which is unknown here.

  private jogBy(index: number, direction: 1 | -1, size = this.step()): Promise<boolean> {
    const by = direction * size;
    const [distance, angle] = index < 3 ? [by / 1000, 0] : [0, by / DEGREES];
    return this.order({ do: "jog-by", group: this.group.name, frame: this.frame, axis: index % 3, distance, angle });
  }

  private async jogTo(index: number, value: number): Promise<boolean> {
    if (this.frame === "tool") {
      await this.jogBy(index, value < 0 ? -1 : 1, Math.abs(value));
      return false;
    }
    const at = (i: number): number | null => (i === index ? value / 1000 : null);
    const turned = this.state && index >= 3 ? inFrame(this.state, this.frame) : null;
    if (turned) turned[index] = value;
    return this.order({ do: "jog-to", group: this.group.name, frame: this.frame, position: [at(0), at(1), at(2)],
      orientation: turned && fromAngles(turned.slice(3)) });
  }

  private jog(index: number, value: number, relative: boolean): Promise<boolean> {
    return this.order({ do: "jog", group: this.group.name, relative, axes: this.rows.map((_, i) => (i === index ? value : null)) });
  }

  /** Send an order; after a rejection every control shows the robot's position again. */
  private async order(request: Jog | JogBy | JogTo): Promise<boolean> {
    const done = await this.view.order(request);
    if (!done) this.show(this.state);
    return done;
  }

  private async copy(form: Copy["form"], name: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(await this.view.link.ask({ do: "copy", group: this.group.name, form }));
      this.view.notice(`Copied as ${name}.`);
    } catch (why) {
      this.view.notice((why as Error).message, "fault");
    }
  }
}

const turnOf = ({ orientation: [w, x, y, z] }: Pose): THREE.Quaternion => new THREE.Quaternion(x, y, z, w);

/** x, y, z in mm and the rotations about x, y, z in degrees (RAPID's EulerZYX) of the TCP in a frame. */
function inFrame(state: RobotPlace, frame: Frame): number[] {
  if (!state.tcp) return [];
  const place = new THREE.Vector3(...state.tcp.position);
  const turn = turnOf(state.tcp);
  if (frame === "work_object") {
    const inverse = turnOf(state.work_object).invert();
    place.sub(new THREE.Vector3(...state.work_object.position)).applyQuaternion(inverse);
    turn.premultiply(inverse);
  }
  const angles = new THREE.Euler().setFromQuaternion(turn, "ZYX");
  return [...place.toArray().map((value) => value * 1000), ...[angles.x, angles.y, angles.z].map((value) => value * DEGREES)];
}

function fromAngles(degrees: readonly number[]): [number, number, number, number] {
  const [x = 0, y = 0, z = 0] = degrees.map((value) => value / DEGREES);
  const turn = new THREE.Quaternion().setFromEuler(new THREE.Euler(x, y, z, "ZYX"));
  return [turn.w, turn.x, turn.y, turn.z];
}

class AxisRow {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly text = h("output", {});
  private readonly field: Field;
  private readonly unit: string;
  private readonly factor: number;

  constructor(private readonly axis: Axis, commands: boolean, step: () => number,
    jog: (value: number, relative: boolean) => Promise<boolean>) {
    this.unit = axis.kind === "revolute" ? "°" : "mm";
    this.factor = axis.kind === "revolute" ? DEGREES : 1000;
    const by = (direction: 1 | -1): void => void jog(direction * step() / this.factor, true);
    this.slider = h("input", {
      type: "range", min: axis.lower, max: axis.upper, step: "any", disabled: !commands,
      "aria-label": `${axis.name}, ${axis.axis}`,
      oninput: () => void jog(Number(this.slider.value), false),
      onkeydown: (event) => {
        // A slider's own keys start from its drawn position, which may differ from the robot's.
        const { key, repeat } = event as KeyboardEvent;
        if (!(key in FORWARD) && !FAR.includes(key)) return;
        event.preventDefault();
        if (key in FORWARD && !repeat) by(FORWARD[key as keyof typeof FORWARD]);
      },
    });
    this.field = new Field({ label: `${axis.name} in ${this.unit}`,
      commit: (value) => jog(value / this.factor, false), step: by });
    const figure = commands ? h("span", { class: "figure" }, this.field.element, this.unit) : this.text;
    const button = (way: 1 | -1): HTMLElement | null => commands ? h("button", { type: "button",
      "aria-label": `${axis.name} ${way < 0 ? "−" : "+"}`, onclick: () => by(way) }, way < 0 ? "−" : "+") : null;
    const limits = h("small", { class: "limits" },
      h("span", {}, this.figures(axis.lower)), h("span", {}, this.figures(axis.upper)));
    this.element = h("div", { class: "axis" }, h("span", { title: axis.axis }, axis.name), h("div", { class: "slide" }, button(-1),
      h("div", {}, this.slider, limits), button(1)), figure);
  }

  private figures(value: number): string {
    return (value * this.factor).toFixed(1);
  }

  show(value: number): void {
    this.slider.value = String(value);
    say(this.text, `${this.figures(value)} ${this.unit}`);
    this.field.show((value * this.factor).toFixed(2));
    this.element.dataset["near"] = nearness(this.axis, value);
  }
}
