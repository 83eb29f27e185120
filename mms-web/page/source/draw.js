// Draws a moving mesh on a canvas: a bar with its graph of u, a mesh in the plane, or faces in space.

/** Colours from low to high (viridis): equal steps look equal, in grey too. */
const SCALE = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"].map((hex) =>
  [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)),
);

/** The scale as a background of a bar. */
export const GRADIENT = `linear-gradient(to right, ${SCALE.map((colour) => `rgb(${colour})`).join(", ")})`;

function colour(value, [low, high]) {
  if (value == null || !Number.isFinite(value)) return "transparent";
  const share = high > low ? Math.min(Math.max((value - low) / (high - low), 0), 1) : 0.5;
  const at = Math.min(Math.floor(share * (SCALE.length - 1)), SCALE.length - 2);
  const part = share * (SCALE.length - 1) - at;
  return `rgb(${SCALE[at].map((channel, index) => Math.round(channel + part * (SCALE[at + 1][index] - channel)))})`;
}

const COS = Math.cos(Math.PI / 6);
/** The position of a point on paper, seen along (-1, 1, -1): x to the right and front, y to the right and back, z up. */
const onPaper = ([x, y = 0, z]) => (z === undefined ? [x, y] : [(x + y) * COS, z + (y - x) / 2]);
/** The nearness of a point to the viewer. */
const nearness = ([x, y, z = 0]) => x - y + z;

/** A drawing of one motion on one canvas. */
export class Drawing {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas, motion, axes) {
    Object.assign(this, { canvas, motion, axes });
    const paper = motion.points.flat().map(onPaper);
    const extent = (at) => paper.reduce(([low, high], point) => [Math.min(low, point[at]), Math.max(high, point[at])], [Infinity, -Infinity]);
    this.x = extent(0);
    this.y = extent(1);
    if (motion.dimension === 1) {
      const moves = motion.points.flatMap((points) => points.map(([x], index) => x - motion.reference[index][0]));
      this.y = moves.reduce(([low, high], u) => [Math.min(low, u), Math.max(high, u)], [0, 0]);
    }
    this.pointwise = motion.values[0].length === motion.points[0].length;
  }

  /** Draws a frame, and a mark at a reference point if one is given. */
  draw(frame, mark) {
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const style = getComputedStyle(canvas);
    this.ink = style.color;
    this.line = style.getPropertyValue("--mesh-line") || "#0006";
    pen.font = `13px ${style.fontFamily}`;
    this.cells = this.motion.dimension === 1 ? this.#bar(pen, width, height, frame) : this.#mesh(pen, width, height, frame);
    if (mark) this.#mark(pen, mark);
  }

  #value(frame, cell, index) {
    const values = this.motion.values[frame];
    if (!this.pointwise) return values[index];
    return cell.reduce((sum, corner) => sum + (values[corner] ?? NaN), 0) / cell.length;
  }

  #mesh(pen, width, height, frame) {
    const points = this.motion.points[frame];
    const border = 28;
    const scale = Math.min((width - 2 * border) / (this.x[1] - this.x[0] || 1), (height - 2 * border) / (this.y[1] - this.y[0] || 1));
    const middle = [(this.x[0] + this.x[1]) / 2, (this.y[0] + this.y[1]) / 2];
    const place = (point) => {
      const [x, y] = onPaper(point);
      return [width / 2 + (x - middle[0]) * scale, height / 2 - (y - middle[1]) * scale];
    };
    const cells = this.motion.cells.map((cell, index) => ({ cell, index, corners: cell.map((corner) => place(points[corner])) }));
    if (this.motion.dimension === 3) {
      for (const one of cells) one.near = one.cell.reduce((sum, corner) => sum + nearness(points[corner]), 0);
      cells.sort((one, other) => one.near - other.near);
    }
    pen.lineWidth = 0.75;
    pen.lineJoin = "round";
    pen.strokeStyle = this.line;
    for (const { cell, index, corners } of cells) {
      pen.fillStyle = colour(this.#value(frame, cell, index), this.motion.range);
      pen.beginPath();
      corners.forEach(([x, y], at) => (at ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
    this.#axes(pen, height);
    return cells;
  }

  /** Draws the directions of the axes in the lower left corner. */
  #axes(pen, height) {
    pen.strokeStyle = pen.fillStyle = this.ink;
    pen.lineWidth = 1.5;
    const from = [26, height - (this.motion.dimension === 3 ? 34 : 20)];
    const directions = this.motion.dimension === 3 ? [[1, 0, 0], [0, 1, 0], [0, 0, 1]] : [[1, 0], [0, 1]];
    directions.map(onPaper).forEach(([x, y], index) => {
      pen.beginPath();
      pen.moveTo(...from);
      pen.lineTo(from[0] + 22 * x, from[1] - 22 * y);
      pen.stroke();
      pen.fillText(this.axes[index], from[0] + 31 * x - 3, from[1] - 31 * y + 4);
    });
  }

  #bar(pen, width, height, frame) {
    const points = this.motion.points[frame];
    const [left, right, thick] = [64, 20, 36];
    const across = (x) => left + ((x - this.x[0]) / (this.x[1] - this.x[0] || 1)) * (width - left - right);
    const cells = this.motion.cells.map((cell, index) => {
      const [from, to] = cell.map((corner) => across(points[corner][0]));
      const corners = [[from, 16], [to, 16], [to, 16 + thick], [from, 16 + thick]];
      pen.fillStyle = colour(this.#value(frame, cell, index), this.motion.range);
      pen.fillRect(from, 16, to - from + 0.5, thick);
      return { cell, index, corners };
    });
    const [top, bottom] = [92, height - 34];
    const up = (u) => bottom - ((u - this.y[0]) / (this.y[1] - this.y[0] || 1)) * (bottom - top);
    pen.fillStyle = pen.strokeStyle = this.ink;
    pen.fillText(this.axes[0], width - right - 8, bottom + 30);
    pen.fillText("u", left - 4, top - 12);
    pen.textAlign = "center";
    for (const x of this.x) pen.fillText(short(x), across(x) - (x === this.x[1] ? 12 : 0), bottom + 16);
    pen.textAlign = "right";
    for (const u of new Set([this.y[0], 0, this.y[1]])) pen.fillText(short(u), left - 8, up(u) + 4);
    pen.textAlign = "left";
    pen.lineWidth = 1;
    pen.globalAlpha = 0.35;
    pen.beginPath();
    pen.moveTo(left, top);
    pen.lineTo(left, bottom);
    pen.moveTo(left, up(0));
    pen.lineTo(width - right, up(0));
    pen.stroke();
    pen.globalAlpha = 1;
    pen.lineWidth = 2;
    pen.beginPath();
    points.forEach(([x], index) => {
      const place = [across(x), up(x - this.motion.reference[index][0])];
      if (index) pen.lineTo(...place);
      else pen.moveTo(...place);
    });
    pen.stroke();
    return cells;
  }

  /** Draws a ring around a mark: a cell, and coordinates in it. */
  #mark(pen, { cell, at }) {
    const drawn = this.cells.find((other) => other.index === cell);
    const [x, y] = blend(drawn.corners, at);
    for (const [style, wide] of [["#000", 4], ["#fff", 2]]) {
      pen.strokeStyle = style;
      pen.lineWidth = wide;
      pen.beginPath();
      pen.arc(x, y, 7, 0, 2 * Math.PI);
      pen.stroke();
    }
  }

  /** Returns the reference point under a place of the canvas, and the mark there; null outside the body. */
  pointAt(x, y) {
    for (const { cell, index, corners } of [...this.cells].reverse()) {
      const at = invert(corners, [x, y]);
      if (!at) continue;
      const reference = cell.map((corner) => this.motion.reference[corner]);
      const point = reference.length === 2 ? blend([...reference, ...[...reference].reverse()], [at[0], 0]) : blend(reference, at);
      return { point, mark: { cell: index, at } };
    }
    return null;
  }
}

const short = (value) => String(Number(value.toPrecision(3)));

/** Blends the four corners of a cell, in order round it, at coordinates from 0 to 1. */
function blend([a, b, c, d], [r, s]) {
  return a.map((_, k) => (1 - r) * (1 - s) * a[k] + r * (1 - s) * b[k] + r * s * c[k] + (1 - r) * s * d[k]);
}

/** Finds the coordinates of a place in a cell by Newton's method; null where it lies outside. */
function invert(corners, [x, y]) {
  const [a, b, c, d] = corners;
  let [r, s] = [0.5, 0.5];
  for (let step = 0; step < 12; step += 1) {
    const [px, py] = blend(corners, [r, s]);
    const along = [0, 1].map((k) => (1 - s) * (b[k] - a[k]) + s * (c[k] - d[k]));
    const across = [0, 1].map((k) => (1 - r) * (d[k] - a[k]) + r * (c[k] - b[k]));
    const area = along[0] * across[1] - along[1] * across[0];
    if (Math.abs(area) < 1e-12) return null;
    r += ((x - px) * across[1] - (y - py) * across[0]) / area;
    s += ((y - py) * along[0] - (x - px) * along[1]) / area;
  }
  const inside = (value) => value >= -1e-6 && value <= 1 + 1e-6;
  return inside(r) && inside(s) ? [r, s] : null;
}
