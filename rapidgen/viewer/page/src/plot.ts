// Self-contained page of curves over time: synced, zoomed by dragging, switched by name.
//
// The page has a <script type="application/json" id="plot-data"> with PlotData and an element #plots.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import "./plot.css";

export interface Curve {
  name: string;
  /** One value for each time; null is a gap. */
  values: (number | null)[];
  /** A CSS colour; by default the next of a list. */
  color?: string;
  dashed?: boolean;
}

export interface Chart {
  title: string;
  unit?: string;
  curves: Curve[];
  /** Displayed times that are shaded: corners. */
  spans?: [number, number][];
  /** Displayed time, text and kind. */
  marks?: [number, string, "stop" | "late" | "event"][];
}

export interface PlotData {
  /** Displayed s, rising; all charts share it. */
  time: number[];
  /** Displayed times of standstills that are cut, and the s that each leaves out. */
  cuts?: [number, number][];
  charts: Chart[];
}

const MARKS = { stop: "#8a929a", late: "#d0402c", event: "#a04bb8" };
const COLOURS = ["#2f6fd0", "#d9662b", "#3a9a50", "#a04bb8", "#c9a227", "#3aa6a6", "#d0402c", "#6b7680"];

/** Draw charts below one another with a common cursor and zoom. */
export function draw(data: PlotData, into: HTMLElement): uPlot[] {
  const sync = uPlot.sync(`charts-${Math.random()}`);
  const charts: uPlot[] = [];
  let zooming = false;
  const zoom = (from: uPlot): void => {
    const { min, max } = from.scales["x"] ?? {};
    if (zooming || min === undefined || max === undefined || min === null || max === null) return;
    zooming = true;
    for (const other of charts) if (other !== from) other.setScale("x", { min, max });
    zooming = false;
  };
  const ink = getComputedStyle(into).color;
  const lines = { grid: { stroke: faint(ink), width: 1 }, ticks: { stroke: faint(ink), width: 1 } };
  const cuts = data.cuts ?? [];
  const real = (time: number): number =>
    cuts.reduce((sum, [at, length]) => (at < time ? sum + length : sum), time);
  const label = cuts.length ? "s, standstills cut" : "s";
  for (const chart of data.charts) {
    const options: uPlot.Options = {
      title: chart.unit ? `${chart.title} (${chart.unit})` : chart.title,
      width: Math.max(320, into.clientWidth), height: 240,
      cursor: { sync: { key: sync.key }, drag: { x: true, y: false } },
      scales: { x: { time: false } },
      axes: [
        { stroke: ink, label, values: (_, ticks) => ticks.map((tick) => `${Number(real(tick).toFixed(3))}`), ...lines },
        { stroke: ink, size: 64, ...lines },
      ],
      series: [{ label: "time", value: (_, value) => (value === null ? "" : `${real(value).toFixed(3)} s`) },
        ...chart.curves.map((curve, i) => ({
          label: curve.name, stroke: curve.color ?? COLOURS[i % COLOURS.length] ?? ink, width: 1.5,
          ...(curve.dashed ? { dash: [6, 4] } : {}),
        }))],
      hooks: {
        setScale: [(own, key) => { if (key === "x") zoom(own); }],
        drawClear: [(own) => shade(own, chart, cuts)],
      },
    };
    charts.push(new uPlot(options, [data.time, ...chart.curves.map((curve) => curve.values)], into));
  }
  new ResizeObserver(() => {
    for (const chart of charts) chart.setSize({ width: Math.max(320, into.clientWidth), height: 240 });
  }).observe(into);
  return charts;
}

/** Draw corners, cuts and marks behind the curves. */
function shade(own: uPlot, chart: Chart, cuts: [number, number][]): void {
  const { ctx, bbox } = own;
  const x = (time: number): number => own.valToPos(time, "x", true);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = "#2a948740";
  for (const [begin, end] of chart.spans ?? []) ctx.fillRect(x(begin), bbox.top, x(end) - x(begin), bbox.height);
  ctx.fillStyle = "#8a929a66";
  const wide = 5 * devicePixelRatio;
  for (const [at] of cuts) ctx.fillRect(x(at) - wide / 2, bbox.top, wide, bbox.height);
  for (const [at, , kind] of chart.marks ?? []) {
    ctx.fillStyle = MARKS[kind];
    ctx.fillRect(x(at), bbox.top, devicePixelRatio, bbox.height);
  }
  ctx.restore();
}

function faint(ink: string): string {
  const [red = 0, green = 0, blue = 0] = ink.match(/[\d.]+/g)?.map(Number) ?? [];
  return `rgba(${red}, ${green}, ${blue}, 0.15)`;
}

const given = document.getElementById("plot-data");
const into = document.getElementById("plots");
if (given && into) draw(JSON.parse(given.textContent ?? "") as PlotData, into);
Object.assign(window, { rapidgenPlot: { draw } });
