// If there are many subjects, lets the reader choose subjects. In the charts, each chosen subject has its own
// row, line or colour. At first, as many subjects are chosen as there are colours.
"use strict";

const subjectNames = Object.keys(report.subjects);
const fewSubjects = 8;
const hasPicker = subjectNames.length > fewSubjects;

/**
 * The subjects, in the order of their names. If there are many, they are grouped by algorithm instead, and
 * within a group sorted by the number of digits of their scalars.
 */
const places = report.verdicts.map((each) => ({ ...each, isAlone: report.verdicts.every((other) => other === each || other.algorithm !== each.algorithm) }));
if (hasPicker) places.sort((a, b) => a.isAlone - b.isAlone || (a.algorithm < b.algorithm ? -1 : a.algorithm > b.algorithm ? 1 : b.epsilon - a.epsilon));

/** Picks `many` evenly spaced entries of a list, including its ends. */
const evenly = (list, many) => (list.length <= many ? list
  : Array.from({ length: many }, (_, i) => list[Math.round(many === 1 ? (list.length - 1) / 2 : (i * (list.length - 1)) / (many - 1))]));

/**
 * Chooses as many subjects as there are colours: first the subjects on Pareto fronts, then other subjects
 * without failures, then subjects with failures.
 */
function firstChoice() {
  const { front_by_distance, front_by_rate, front_by_earliness, ladder } = report.error_against_time;
  const fronts = new Set([...(ladder ?? { front_by_distance }).front_by_distance, ...front_by_rate, ...front_by_earliness]);
  const choice = new Set();
  const groups = [(place) => fronts.has(place.subject), (place) => place.clean && isNoRung(place), (place) => place.clean, () => true];
  for (const group of groups) {
    const names = places.filter((place) => group(place) && !choice.has(place.subject)).map((place) => place.subject);
    for (const name of evenly(names, palette.length - choice.size)) choice.add(name);
  }
  return choice;
}

/** Maps each chosen subject to the index of its colour. A subject keeps its colour while it is chosen. */
const chosenColors = new Map();

/** Chooses these subjects. If a subject's usual colour is taken, the subject gets the first free colour. */
function choose(choice) {
  for (const subject of chosenColors.keys()) if (!choice.has(subject)) chosenColors.delete(subject);
  const isFree = (index) => ![...chosenColors.values()].includes(index);
  for (const { subject } of places) {
    if (!choice.has(subject) || chosenColors.has(subject)) continue;
    let index = subjectNames.indexOf(subject);
    if (hasPicker && !isFree(index %= palette.length)) for (index = 0; !isFree(index); ++index);
    chosenColors.set(subject, index);
  }
}
choose(hasPicker ? firstChoice() : new Set(subjectNames));

const isChosen = ({ subject }) => chosenColors.has(subject);
const chosenNames = () => places.filter(isChosen).map((place) => place.subject);
const paletteColor = (index) => palette[index % palette.length];
const subjectColor = { field: "subject", type: "nominal", title: "subject",
  scale: { domain: subjectNames, range: subjectNames.map((_, i) => paletteColor(i)) } };

/**
 * Colours of the chosen subjects, with a legend.
 * @param others the colour of subjects that are not chosen, if a chart draws them
 */
function chosenColor(others) {
  const names = chosenNames();
  const colors = names.map((name) => paletteColor(chosenColors.get(name)));
  const rest = others ? subjectNames.filter((name) => !chosenColors.has(name)) : [];
  const columns = Math.floor(element("how").clientWidth / (45 + 6 * Math.max(...names.map((name) => name.length))));
  return { field: "subject", type: "nominal", title: "subject", scale: { domain: [...names, ...rest], range: [...colors, ...rest.map(() => others)] },
    legend: { columns: Math.max(1, Math.min(8, columns)) } };
}

/** Draws the picker. After each change, the picker calls `redraw`. */
function drawPicker(redraw) {
  show("picker");
  const boxes = new Map();
  const update = () => {
    const names = chosenNames();
    for (const [subject, box] of boxes) box.checked = chosenColors.has(subject);
    element("picker-count").textContent = `Subjects in the charts below: ${names.length} of ${subjectNames.length}`;
    element("picker-legend").replaceChildren(...(names.length > palette.length ? [] : names).map((name) =>
      made("span", [made("span", "", { class: "swatch", style: `background: ${paletteColor(chosenColors.get(name))}` }), ` ${name}`])));
  };
  const change = (choice) => {
    choose(choice);
    update();
    redraw();
  };
  const changed = (subjects, are) => {
    const choice = new Set(chosenNames());
    for (const subject of subjects) are ? choice.add(subject) : choice.delete(subject);
    change(choice);
  };
  const button = (title, act, hint) => {
    const node = made("button", title, { type: "button", ...(hint ? { title: hint } : {}) });
    node.addEventListener("click", act);
    return node;
  };
  const checkbox = ({ subject }, title) => {
    const box = made("input", [], { type: "checkbox", value: subject });
    box.addEventListener("change", () => changed([subject], box.checked));
    boxes.set(subject, box);
    return made("label", [box, ` ${title}`], { title: subject });
  };
  const group = (title, members, titleOf) => {
    const subjects = members.map((place) => place.subject);
    const toggle = () => changed(subjects, !subjects.every((subject) => chosenColors.has(subject)));
    return made("fieldset", [made("legend", button(title, toggle, "choose all or none of these")), ...members.map((place) => checkbox(place, titleOf(place)))]);
  };
  const alone = places.filter((place) => place.isAlone);
  const algorithms = [...new Set(places.filter((place) => !place.isAlone).map((place) => place.algorithm))];
  element("picker-choices").append(
    made("div", [button("all", () => change(new Set(subjectNames))), button("none", () => change(new Set())),
      button("reset", () => change(firstChoice()))], { class: "buttons" }),
    ...algorithms.map((name) => group(name, places.filter((place) => place.algorithm === name), (place) => place.scalar)),
    ...(alone.length === 0 ? [] : [group(algorithms.length === 0 ? "subjects" : "others", alone, (place) => place.subject)]));
  update();
}
