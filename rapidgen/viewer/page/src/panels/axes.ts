// Axes of each robot within their limits; jogging in a simulation.

import { Choice, h, say, Field } from "../dom";
import type { Axis, Copy, Jog, JogTo, SeenRobot, RobotPlace } from "../messages";
import type { MakePanel, View } from "../panel";
import { nearness } from "../stage/palette";

const FORMS: readonly (readonly [Copy["form"], string])[] =
  [["jointtarget", "jointtarget"], ["robtarget", "robtarget"], ["python", "Python"]];
const STEPS = [["0.1", "0.1"], ["1", "1"], ["5", "5"]] as const;
type Step = (typeof STEPS)[number][0];
const FORWARD = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 } as const;
const FAR = ["Home", "End", "PageUp", "PageDown"]; // keys that would move a slider by more than a step

export const axesPanel: MakePanel = (view) => {
  const element = h("div", { class: "panel" });
  let robots: RobotAxes[] = [];
  let step: Step = "1";
  const steps = new Choice<Step>("Step in ° or mm", STEPS, (value) => steps.show(step = value));
  steps.show(step);
  view.link.on("scene", (scene) => {
    robots = scene.groups.map((group) => new RobotAxes(group, scene.may_command, view, () => Number(step)));
    element.replaceChildren(h("div", { class: "row commands", hidden: !scene.may_command },
      h("span", { class: "label" }, "Arrow keys move by"), steps.element, h("span", { class: "label" }, "° or mm")),
      ...robots.map((robot) => robot.element));
  });
  view.link.on("positions", (state) => robots.forEach((robot, i) => robot.show(state.groups[i])));
  return { id: "axes", title: "Axes", element };
};

class RobotAxes {
  readonly element: HTMLElement;
  private readonly rows: AxisRow[];
  private readonly pose = h("output", { class: "pose" });
  private readonly place: Field[];
  private state: RobotPlace | undefined;

  constructor(private readonly group: SeenRobot, commands: boolean, private readonly view: View, step: () => number) {
    this.rows = group.axes.map((axis, i) => new AxisRow(axis, commands, step, (value, relative) => this.jog(i, value, relative)));
    const buttons = FORMS.map(([form, name]) =>
      h("button", { type: "button", onclick: () => void this.copy(form, name) }, name));
    this.place = ["x", "y", "z"].map((name, i) => new Field({
      label: `TCP ${name} of ${group.name} in mm`,
      commit: (value) => this.jogTo(i, value / 1000),
      step: (direction) => {
        const now = this.state?.tcp?.position[i];
        if (now !== undefined) void this.jogTo(i, now + direction * step() / 1000);
      },
    }));
    this.element = h("section", {}, h("h2", {}, `${group.name} · ${group.task}`),
      h("div", { class: "axes" }, ...this.rows.map((row) => row.element)), this.pose,
      h("div", { class: "row commands place", hidden: !commands || !group.has_geometry },
        h("span", { class: "label" }, "TCP to"), ...this.place.map((field) => field.element), h("span", { class: "label" }, "mm")),
      h("div", { class: "row" }, h("span", { class: "label" }, "Copy as"), ...buttons));
  }

  show(state: RobotPlace | undefined): void {
    if (!state) return;
    this.state = state;
    this.rows.forEach((row, i) => row.show(state.axes[i] ?? 0));
    if (state.tcp) {
      const [x, y, z] = state.tcp.position.map((value) => (value * 1000).toFixed(1));
      say(this.pose, `TCP  x ${x}  y ${y}  z ${z} mm`);
      [x, y, z].forEach((value, i) => this.place[i]?.show(value ?? ""));
    }
  }

  // An axis without a value keeps its position at the arrival of the order, which is unknown here.

  private jogTo(index: number, value: number): Promise<boolean> {
    const at = (i: number): number | null => (i === index ? value : null);
    return this.order({ do: "jog-to", group: this.group.name, position: [at(0), at(1), at(2)], orientation: null });
  }

  private jog(index: number, value: number, relative: boolean): Promise<boolean> {
    return this.order({ do: "jog", group: this.group.name, relative, axes: this.rows.map((_, i) => (i === index ? value : null)) });
  }

  /** Send an order; after a refusal every control shows the robot's position again. */
  private async order(request: Jog | JogTo): Promise<boolean> {
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
    this.factor = axis.kind === "revolute" ? 180 / Math.PI : 1000;
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
    const limits = h("small", { class: "limits" },
      h("span", {}, this.figures(axis.lower)), h("span", {}, this.figures(axis.upper)));
    this.element = h("div", { class: "axis" }, h("span", {}, axis.name),
      h("div", {}, this.slider, limits), figure);
  }

  private figures(value: number): string {
    return (value * this.factor).toFixed(1);
  }

  show(value: number): void {
    this.slider.value = String(value);
    say(this.text, `${this.figures(value)} ${this.unit}`);
    this.field.show(this.figures(value));
    this.element.dataset["near"] = nearness(this.axis, value);
  }
}
