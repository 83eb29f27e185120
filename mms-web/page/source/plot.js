// Draws errors over mesh sizes, both on scales of logarithms, as a picture in SVG.
import { shown } from "./dom.js";

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [640, 360, 70, 200, 16, 44];

const escaped = (words) => String(words).replaceAll("&", "&amp;").replaceAll("<", "&lt;");

/** Returns the SVG of lines: each has a label and points [h, error]. */
export function plot(lines) {
  const points = lines.flatMap((line) => line.points);
  const scale = (at, from, to) => {
    const logs = points.map((point) => Math.log10(point[at]));
    const [low, high] = [Math.min(...logs), Math.max(...logs)];
    const border = 0.08 * (high - low) || 0.5;
    return (value) => from + ((Math.log10(value) - low + border) / (high - low + 2 * border)) * (to - from);
  };
  const across = scale(0, LEFT, WIDTH - RIGHT);
  const up = scale(1, HEIGHT - BOTTOM, TOP);
  const text = (x, y, words, anchor = "middle") => `<text x="${x}" y="${y}" text-anchor="${anchor}">${escaped(words)}</text>`;
  const decades = [];
  for (let power = -300; power <= 300; power += 1) {
    const y = up(10 ** power);
    if (y > TOP && y < HEIGHT - BOTTOM) decades.push(`<path d="M${LEFT} ${y}H${WIDTH - RIGHT}" stroke="#ddd"/>${text(LEFT - 6, y + 4, `1e${power}`, "end")}`);
  }
  const sizes = [...new Set(points.map(([h]) => h))].map((h) => text(across(h), HEIGHT - BOTTOM + 18, shown(h)));
  const drawn = lines.map(({ label, points: of }, index) => {
    const colour = COLOURS[index % COLOURS.length];
    const places = of.map(([h, error]) => [across(h), up(error)]);
    const dots = places.map(([x, y]) => `<circle cx="${x}" cy="${y}" r="4" fill="${colour}"/>`).join("");
    const y = TOP + 14 + 20 * index;
    const key = `<circle cx="${WIDTH - RIGHT + 18}" cy="${y - 4}" r="4" fill="${colour}"/>${text(WIDTH - RIGHT + 28, y, label, "start")}`;
    return `<polyline points="${places.join(" ")}" fill="none" stroke="${colour}" stroke-width="2" ${index % 2 ? 'stroke-dasharray="6 3"' : ""}/>${dots}${key}`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${HEIGHT}" width="${WIDTH}" height="${HEIGHT}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="#fff"/>${decades.join("")}<path d="M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}" fill="none" stroke="#000"/>
${sizes.join("")}${drawn.join("")}${text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, "mesh size h")}${text(16, TOP + 8, "error", "start")}</svg>`;
}
