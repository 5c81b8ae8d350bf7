// The axes of each robot: where they stand between their limits; in a simulation they are jogged here.

import { h, say } from "../dom";
import type { Axis, Copy, SeenRobot, RobotPlace } from "../messages";
import type { MakePanel, View } from "../panel";
import { nearness } from "../stage/nearness";

const FORMS: readonly (readonly [Copy["form"], string])[] =
  [["jointtarget", "jointtarget"], ["robtarget", "robtarget"], ["python", "Python"]];

export const axesPanel: MakePanel = (view) => {
  const element = h("div", { class: "panel" });
  let robots: RobotAxes[] = [];
  view.link.on("scene", (scene) => {
    robots = scene.groups.map((group) => new RobotAxes(group, scene.may_command, view));
    element.replaceChildren(...robots.map((robot) => robot.element));
  });
  view.link.on("positions", (state) => robots.forEach((robot, i) => robot.show(state.groups[i])));
  return { id: "axes", title: "Axes", element };
};

class RobotAxes {
  readonly element: HTMLElement;
  private readonly rows: AxisRow[];
  private readonly pose = h("output", { class: "pose" });
  private readonly place: HTMLInputElement[];

  constructor(private readonly group: SeenRobot, commands: boolean, private readonly view: View) {
    this.rows = group.axes.map((axis, i) => new AxisRow(axis, commands, (value) => this.jog(i, value)));
    const buttons = FORMS.map(([form, name]) =>
      h("button", { type: "button", onclick: () => void this.copy(form, name) }, name));
    const numbers = ["x", "y", "z"].map((name, i) => {
      const input: HTMLInputElement = h("input", { type: "number", step: 1, "aria-label": `TCP ${name} of ${group.name} in mm`,
        onchange: () => this.jogTo(i, Number(input.value) / 1000) });
      return input;
    });
    this.place = numbers;
    this.element = h("section", {}, h("h2", {}, `${group.name} · ${group.task}`),
      h("div", { class: "axes" }, ...this.rows.map((row) => row.element)), this.pose,
      h("div", { class: "row commands place", hidden: !commands || !group.has_geometry },
        h("span", { class: "label" }, "TCP to"), ...numbers, h("span", { class: "label" }, "mm")),
      h("div", { class: "row" }, h("span", { class: "label" }, "Copy as"), ...buttons));
  }

  show(state: RobotPlace | undefined): void {
    if (!state) return;
    this.rows.forEach((row, i) => row.show(state.axes[i] ?? 0));
    if (state.tcp) {
      const [x, y, z] = state.tcp.position.map((value) => (value * 1000).toFixed(1));
      say(this.pose, `TCP  x ${x}  y ${y}  z ${z} mm`);
      [x, y, z].forEach((value, i) => {
        const input = this.place[i];
        if (input && document.activeElement !== input) input.value = value ?? "";
      });
    }
  }

  // What is not asked for stays as it is when the order arrives, which is not known here yet.

  private jogTo(index: number, value: number): void {
    const at = (i: number): number | null => (i === index ? value : null);
    this.view.order({ do: "jog-to", group: this.group.name, position: [at(0), at(1), at(2)], orientation: null });
  }

  private jog(index: number, value: number): void {
    this.view.order({ do: "jog", group: this.group.name, axes: this.rows.map((_, i) => (i === index ? value : null)) });
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
  private readonly unit: string;
  private readonly factor: number;

  constructor(private readonly axis: Axis, commands: boolean, jog: (value: number) => void) {
    this.unit = axis.kind === "revolute" ? "°" : " mm";
    this.factor = axis.kind === "revolute" ? 180 / Math.PI : 1000;
    this.slider = h("input", {
      type: "range", min: axis.lower, max: axis.upper, step: "any", disabled: !commands,
      "aria-label": `${axis.name}, ${axis.axis}`,
      oninput: () => jog(Number(this.slider.value)),
    });
    const range = `${this.said(axis.lower)} … ${this.said(axis.upper)}`;
    this.element = h("div", { class: "axis", title: range },
      h("span", {}, axis.name), this.slider, this.text);
  }

  private said(value: number): string {
    return `${(value * this.factor).toFixed(1)}${this.unit}`;
  }

  show(value: number): void {
    this.slider.value = String(value);
    say(this.text, this.said(value));
    this.element.dataset["near"] = nearness(this.axis, value);
  }
}
