// Who is connected, and what goes wrong at a click.

import { h, section } from "../dom";
import type { Act } from "../messages";
import type { MakePanel } from "../panel";

const FAULTS: readonly (readonly [Act["action"], string])[] =
  [["e-stop", "Emergency stop"], ["motors-off", "Motors off"], ["stop", "Program stop"], ["power-loss", "Power failure"]];

export const connectionsPanel: MakePanel = ({ link, order }) => {
  const body = h("tbody", {});
  link.on("connections", ({ sockets }) => {
    body.replaceChildren(...sockets.map((socket) => h("tr", {},
      h("th", { scope: "row" }, socket.peer || `${socket.status} on ${socket.local}`,
        h("small", {}, `${socket.task}${socket.peer ? ` · ${socket.local}` : ""}`)),
      h("td", {}, socket.peer
        ? h("button", { type: "button", class: "commands", onclick: () => order({ do: "cut", number: socket.number }) }, "Cut")
        : null))));
  });
  const faults = FAULTS.map(([action, text]) =>
    h("button", { type: "button", onclick: () => order({ do: "act", action }) }, text));
  const element = h("div", { class: "panel" },
    section("Sockets of the program", h("table", { class: "sockets" }, body)),
    h("div", { class: "commands" }, section("Let something go wrong", h("div", { class: "row" }, ...faults))));
  return { id: "connections", title: "Network", element, kinds: ["simulation"] };
};
