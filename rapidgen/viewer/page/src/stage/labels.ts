// Names at places of the space: text over the picture, moved with it.

import * as THREE from "three";
import { h } from "../dom";

interface Label {
  readonly element: HTMLElement;
  readonly at: () => THREE.Vector3;
}

export class Labels {
  readonly element = h("div", { class: "labels", "aria-hidden": "true" });
  private labels: Label[] = [];

  /** Other names; `at` says where each is when it is drawn. */
  set(names: readonly { text: string; at: () => THREE.Vector3 }[]): void {
    this.labels = names.map(({ text, at }) => ({ element: h("span", {}, text), at }));
    this.element.replaceChildren(...this.labels.map((label) => label.element));
  }

  draw(camera: THREE.Camera, width: number, height: number): void {
    if (this.element.hidden) return;
    for (const { element, at } of this.labels) {
      const seen = at().project(camera);
      const inside = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      element.hidden = !inside;
      if (inside)
        element.style.transform = `translate(${((seen.x + 1) / 2) * width}px, ${((1 - seen.y) / 2) * height}px)`;
    }
  }
}
