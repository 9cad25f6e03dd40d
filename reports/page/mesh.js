// Draws a step of a scene: its mesh, with collisions and wrong answers marked. Mouse and keys turn the
// picture.
"use strict";

/**
 * Colours of marked primitives: a list with the bits of a mark, their meaning, and the name of the colour.
 * The first entry that matches a mark applies.
 */
function markColours(meanings, subject) {
  const bit = (meaning) => (meanings.includes(meaning) ? 1 << meanings.indexOf(meaning) : 0);
  return [
    { bits: bit(`missed by ${subject}`), name: `missed by ${subject}`, colour: "--bad" },
    { bits: bit(`falsely reported by ${subject}`), name: `falsely reported by ${subject}`, colour: "--false" },
    { bits: bit("tangled"), name: "tangled", colour: "--bad" },
    { bits: bit("collides"), name: "collides", colour: "--second" },
  ];
}

const numbersOf = (text) => (text === "" ? [] : text.split(" ").map(Number));

/** The primitives of a picture, as a list of {points: [indices], mark}. */
function primitivesOf(picture) {
  const cut = (text, size) => {
    const list = numbersOf(text);
    return Array.from({ length: list.length / (size + 1) }, (_, i) =>
      ({ points: list.slice(i * (size + 1), i * (size + 1) + size), mark: list[i * (size + 1) + size] }));
  };
  return [...cut(picture.triangles, 3), ...cut(picture.lines, 2), ...cut(picture.dots, 1)];
}

/** @param picture an entry of report.pictures; reports/campaign/scene_picture.hpp describes its format */
function drawMesh(picture) {
  const primitives = primitivesOf(picture);
  const marked = primitives.filter((primitive) => primitive.mark !== 0);
  const subjects = [...new Set(picture.meanings.filter((m) => m.startsWith("missed by ")).map((m) => m.slice("missed by ".length)))];
  const points = numbersOf(picture.points);
  const count = points.length / 6;
  const middle = [0, 1, 2].map((k) => {
    let [lo, hi] = [Infinity, -Infinity];
    for (let i = 0; i < count; ++i)
      for (const at of [k, 3 + k]) {
        lo = Math.min(lo, points[6 * i + at]);
        hi = Math.max(hi, points[6 * i + at]);
      }
    return (lo + hi) / 2;
  });
  const wrongBits = (subject) => markColours(picture.meanings, subject).slice(0, 2).reduce((bits, each) => bits | each.bits, 0);
  const wrong = subjects.find((subject) => primitives.some((primitive) => primitive.mark & wrongBits(subject)));
  const view = { yaw: -0.6, pitch: 0.45, zoom: 1, time: 1, subject: wrong ?? subjects[0] };

  const canvas = made("canvas", [], { class: "mesh", tabindex: "0", role: "img", "aria-label":
    `The mesh of ${picture.step.replace(/^scene:/, "")}: ${integer(marked.length)} of ${integer(primitives.length)} primitives are marked; ` +
    "arrow keys turn the picture, + and - change its size" });
  const legend = made("div", [], { class: "mesh-legend" });

  /** The positions of all points on the screen at the view's time: x, y, and depth away from the eye. */
  function seen(size) {
    const at = new Float64Array(3 * count);
    const scale = (view.zoom * size) / 13000;
    const [sy, cy, sp, cp] = [Math.sin(view.yaw), Math.cos(view.yaw), Math.sin(view.pitch), Math.cos(view.pitch)];
    for (let i = 0; i < count; ++i) {
      const [x, y, z] = [0, 1, 2].map((k) =>
        (1 - view.time) * points[6 * i + k] + view.time * points[6 * i + 3 + k] - middle[k]);
      const depth = cy * y - sy * x;
      at[3 * i] = size / 2 + scale * (cy * x + sy * y);
      at[3 * i + 1] = size / 2 - scale * (cp * z + sp * depth);
      at[3 * i + 2] = scale * (cp * depth - sp * z);
    }
    return at;
  }

  function draw() {
    const colours = markColours(picture.meanings, view.subject).map((each) => ({ ...each, paint: color(each.colour) }));
    const size = 480;
    const dense = 2; // sharp on paper and on fine screens
    canvas.width = canvas.height = dense * size;
    const paint = canvas.getContext("2d");
    paint.scale(dense, dense);
    paint.lineJoin = "round";
    const at = seen(size);
    const depth = (primitive) => primitive.points.reduce((sum, p) => sum + at[3 * p + 2], 0) / primitive.points.length;
    const inOrder = primitives.map((primitive) => ({ primitive, depth: depth(primitive), hit: colours.find((each) => primitive.mark & each.bits) }))
      .sort((a, b) => b.depth - a.depth);
    for (const { primitive, hit } of inOrder) {
      const [first, ...others] = primitive.points;
      paint.beginPath();
      if (others.length === 0) {
        paint.arc(at[3 * first], at[3 * first + 1], hit ? 2.2 : 1.2, 0, 7);
        paint.fillStyle = hit ? hit.paint : color("--soft");
        paint.fill();
        continue;
      }
      paint.moveTo(at[3 * first], at[3 * first + 1]);
      for (const p of others) paint.lineTo(at[3 * p], at[3 * p + 1]);
      paint.closePath();
      paint.strokeStyle = hit ? hit.paint : color("--soft");
      paint.lineWidth = hit ? 1 : 0.3;
      if (others.length === 2) {
        paint.fillStyle = hit ? hit.paint : color("--face");
        paint.fill();
      }
      paint.stroke();
    }
    legend.replaceChildren(...colours.flatMap(({ bits, name, paint: fill }) => {
      const number = primitives.filter((primitive) => primitive.mark & bits).length;
      const swatch = made("span", [], { class: "swatch" });
      swatch.style.background = fill;
      return number === 0 ? [] : [made("span", [swatch, ` ${name} (${integer(number)}) `])];
    }));
  }

  function change(next) {
    Object.assign(view, next);
    draw();
  }
  const keys = { "+": () => change({ zoom: view.zoom * 1.3 }), "-": () => change({ zoom: view.zoom / 1.3 }) };
  makeTurnable(canvas, view, 120, draw, keys);
  const button = (label, key) => {
    const node = made("button", key, { type: "button", "aria-label": label });
    node.addEventListener("click", keys[key]);
    return node;
  };
  const time = made("input", [], { type: "range", min: "0", max: "1", step: "0.01", value: "1" });
  time.addEventListener("input", () => change({ time: Number(time.value) }));
  const which = made("select", subjects.map((name) => made("option", name, { value: name })));
  which.value = view.subject;
  which.addEventListener("change", () => change({ subject: which.value }));
  draw();
  return made("figure", [
    made("figcaption", [made("strong", picture.step.replace(/^scene:/, "")),
      primitives.length < picture.primitives ? `: ${integer(primitives.length)} of ${integer(picture.primitives)} primitives are shown` : ""]),
    canvas, legend,
    made("div", [made("label", ["t ", time]), ...(subjects.length > 1 ? [made("label", [" answers of ", which])] : []), " ",
      button("larger", "+"), button("smaller", "-")], { class: "mesh-controls" }),
  ], { class: "scene-picture" });
}
