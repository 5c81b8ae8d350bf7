// Editors that debug this simulation: the target under their cursor in the scene, and a button that opens the
// program pointer's line there.

import * as THREE from "three";
import { h, say } from "./dom";
import type { Debugging, Pointers, SeenPlace, SeenTarget } from "./messages";
import type { View } from "./panel";
import { axes, place } from "./stage/robot";
import { palette } from "./stage/palette";

export class EditorLink {
  /** For the bar of the page; hidden without an editor. */
  readonly element: HTMLElement;
  private readonly marks = new THREE.Group();
  private readonly text = h("span", { class: "chip" });
  private targets: readonly SeenTarget[] = [];
  private pointers: Pointers | null = null;
  private halt: Debugging["halt"] = null;

  constructor(private readonly view: View) {
    const open = h("button", { type: "button", class: "quiet", title: "Open the line of the program pointer in the editor", onclick: () => {
      const at = this.pointer;
      if (at) void view.order({ do: "open-in-editor", module: at.module, line: at.line });
      else view.notice("No task has a program pointer.", "fault");
    } }, "Pointer in editor");
    this.element = h("span", { class: "editor-link", hidden: true }, this.text, open);
    view.link.on("pointers", (pointers) => { this.pointers = pointers; });
    view.link.on("debugging", ({ halt }) => { this.halt = halt; });
    view.link.on("editor", ({ attached, module, line, targets }) => {
      this.element.hidden = !attached;
      const names = [...new Set(targets.map((target) => target.name || "target"))].join(", ");
      say(this.text, module ? `Editor: ${names ? `${names} · ` : ""}${module}, line ${line}` : "Editor");
      this.draw(targets);
    });
    // Robots of a new scene have no marks yet.
    view.link.on("scene", () => this.draw(this.targets));
  }

  /** For tests: the drawn targets. */
  get seen(): readonly SeenTarget[] {
    return this.marks.parent ? this.targets : [];
  }

  /** The innermost place of the task that has paused, else of the first one with a program. */
  private get pointer(): SeenPlace | undefined {
    const tasks = this.pointers?.tasks ?? [];
    const paused = tasks.find((task) => task.name === this.halt?.task);
    return this.halt?.place ?? paused?.stack.at(-1) ?? tasks.find((task) => task.stack.length)?.stack.at(-1);
  }

  private draw(targets: readonly SeenTarget[]): void {
    this.targets = targets;
    this.marks.removeFromParent();
    this.marks.traverse((part) => {
      if (part instanceof THREE.Mesh || part instanceof THREE.LineSegments) part.geometry.dispose();
    });
    this.marks.clear();
    const stage = this.view.stage;
    const [first] = targets;
    const robot = first && stage?.robots.get(first.group);
    if (!stage || !robot) return stage?.draw();
    const colours = palette();
    for (const { pose } of targets.filter((target) => target.group === first.group)) {
      const mark = new THREE.Group();
      place(mark, pose);
      // Seen through the robot, which may stand at its target.
      const shade = new THREE.MeshBasicMaterial({ color: colours.accent, depthTest: false, transparent: true, opacity: 0.55 });
      mark.add(new THREE.Mesh(new THREE.SphereGeometry(0.018, 20, 12), shade), axes(0.14, colours));
      this.marks.add(mark);
    }
    robot.root.add(this.marks);
    stage.draw();
  }
}
