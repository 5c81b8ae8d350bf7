// Collision checks of the simulation: near pairs, the first contact, and what is not checked.

import { h, say, section, Rows, type Row } from "../dom";
import type { Collisions, SeenContact, SeenPair } from "../messages";
import type { MakePanel } from "../panel";

const VERDICTS: Record<SeenPair["verdict"], string> = { contact: "Contact", "too near": "Too near", near: "Near" };
const STATES: Record<SeenPair["verdict"], string> = { contact: "error", "too near": "warning", near: "" };

export const collisionsPanel: MakePanel = ({ link, stage }) => {
  const none = h("p", { class: "soft" }, "The simulation checks no collisions. Start it with a cell file that has `collision:`.");
  const free = h("p", { class: "soft" }, "No two bodies are nearer than 100 mm.");
  const body = h("tbody", {});
  const rows = new Rows<SeenPair>(body, (pair) => pair.bodies.join("\n"), pairRow);
  const table = h("table", { class: "pairs" },
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Bodies"), ...["Distance", "Clearance", "Result"].map((text) => h("th", { scope: "col" }, text)))), body);
  const first = h("p", { role: "status" });
  const ghost: HTMLButtonElement = h("button", { type: "button", class: "toggle", "aria-pressed": "false", onclick: () => {
    const shown = ghost.getAttribute("aria-pressed") !== "true";
    ghost.setAttribute("aria-pressed", String(shown));
    stage?.showContact(shown);
  } }, "Show robots at the first contact");
  const unchecked = h("ul", { class: "soft" });
  const checks = h("div", { hidden: true },
    section("Near pairs", free, table), section("First contact", first, ghost), section("Not checked", unchecked),
    h("p", { class: "soft" }, "Collision checks are not a safety function."));

  link.on("scene", () => {
    checks.hidden = true;
    none.hidden = false;
    stage?.collide({ bodies: [] });
    stage?.meet(null);
  });
  link.on("bodies", (bodies) => {
    checks.hidden = false;
    none.hidden = true;
    unchecked.replaceChildren(...bodies.unchecked.map((text) => h("li", {}, text)));
    stage?.collide(bodies);
  });
  link.on("collisions", (now: Collisions) => {
    rows.show(now.near);
    table.hidden = !now.near.length;
    free.hidden = now.near.length > 0;
    say(first, now.first ? contactText(now.first) : "No contact since the start of the controller.");
    ghost.hidden = !now.first || !stage;
    stage?.clear(now);
    stage?.meet(now.first);
  });
  return { id: "collisions", title: "Collisions", kinds: ["simulation"], element: h("div", { class: "panel" }, none, checks) };
};

const mm = (value: number): string => `${(value * 1000).toFixed(1)} mm`;

function contactText({ time, bodies, point, depth, place }: SeenContact): string {
  const at = point.map((value) => (value * 1000).toFixed(0)).join(", ");
  return `${bodies.join(" touches ")} at ${time.toFixed(3)} s, at (${at}) mm, ${mm(depth)} deep.${place ? ` Move: ${place}.` : ""}`;
}

function pairRow(pair: SeenPair): Row<SeenPair> {
  const [distance, result] = [h("td", {}), h("td", {})];
  const element = h("tr", {}, h("th", { scope: "row" }, pair.bodies.join(" – ")), distance, h("td", {}, mm(pair.clearance)), result);
  return { element, show: (now) => {
    say(distance, mm(now.distance));
    say(result, VERDICTS[now.verdict]);
    result.dataset["state"] = STATES[now.verdict];
  } };
}
