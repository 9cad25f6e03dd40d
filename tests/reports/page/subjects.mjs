// Tests the picker for many subjects, and the charts that it redraws.
import assert from "node:assert/strict";
import { count, jsonOf, makeReport, open, pageOf, run } from "./session.mjs";

/**
 * At first, all subjects are chosen, because there are enough colours for all of them. If the user chooses
 * other subjects, the page redraws the charts that have a row or a line for each subject.
 */
export async function showsAChoiceOfManySubjects(browser) {
  const names = "wang:float,wang:p40,wang:p64,wang-tight:float,wang-tight:p40,wang,wang-tight,basic,basic-plain,exact,adaptive".split(",");
  const page = await open(browser, makeReport("many", ["--cases", "600", "--kind", "vt,ee", "--search", "--subject", names.join(",")]));
  const { verdicts, error_against_time, subjects } = jsonOf("many");
  const bad = verdicts.filter((each) => !each.clean).map((each) => each.subject);
  assert.ok(bad.includes("basic") && names.length - bad.length > 8);
  assert.equal(await page.locator(".verdict.bad").first().isVisible(), true);
  assert.equal(await page.isVisible("#clean-subjects"), false);
  await page.click("#scorecard button:has-text('did not fail')");
  const rungs = verdicts.filter((each) => each.clean && each.algorithm !== each.subject);
  assert.equal(await count(page, "#clean-subjects .verdict:visible"), rungs.length);

  const families = (name) => Object.keys(subjects[name].vt.families).filter((family) => family.startsWith("search"));
  assert.deepEqual(families("wang"), ["search-early", "search-far", "search-late", "search-miss"]);

  const chosen = () => page.locator("#picker input:checked").evaluateAll((all) => all.map((each) => each.value));
  const shown = () => page.locator("#stages .role-axis-label text").allTextContents()
    .then((labels) => labels.filter((label) => !label.endsWith("%")));
  const rows = (some) => new Set(some.flatMap((name) => [`${name} vt`, `${name} ee`]));
  const isAsChosen = async (some) => {
    await page.waitForSelector("body[data-drawn]");
    assert.deepEqual(new Set(await chosen()), new Set(some));
    assert.deepEqual(new Set(await shown()), rows(some));
    const lines = some.flatMap((name) => Object.values(subjects[name])).filter((each) => each.false_positives > 0).length;
    assert.equal(await count(page, "#distances .mark-line path"), 2 * lines);
    const timed = some.flatMap((name) => Object.values(subjects[name])).filter((each) => each.times_given > 0).length;
    assert.equal(await count(page, "#time-errors .mark-area path"), timed);
    assert.match(await page.textContent("#picker-count"), new RegExp(`: ${some.length} of ${names.length}$`));
    const rates = await page.locator("#rates svg.marks").boundingBox();
    assert.ok(rates.height < 2500);
  };
  const first = await chosen();
  assert.deepEqual(new Set(first), new Set(names)); // each subject has a colour
  const front = [...(error_against_time.ladder ?? error_against_time).front_by_distance, ...error_against_time.front_by_rate, ...error_against_time.front_by_earliness];
  for (const name of front) assert.ok(first.includes(name), name);
  await isAsChosen(first);
  assert.equal(await count(page, "#picker-legend .swatch"), names.length);

  assert.equal(await page.isVisible("#picker-choices"), false);
  await page.focus("#picker summary");
  await page.keyboard.press("Enter");
  assert.equal(await page.isVisible("#picker-choices"), true);
  await page.locator(`#picker input[value="${first[0]}"]`).focus();
  await page.keyboard.press("Space");
  await isAsChosen(first.slice(1));
  const press = (name) => page.locator("#picker button", { hasText: new RegExp(`^${name}$`) }).click();
  await press("none");
  await page.waitForSelector("body[data-drawn]");
  assert.equal(await page.locator("#stages svg.marks").isVisible(), false);
  const ofWang = names.filter((name) => name === "wang" || name.startsWith("wang:"));
  await press("wang");
  await isAsChosen(ofWang);
  await press("all");
  await press("wang"); // even before all charts are drawn
  await isAsChosen(names.filter((name) => !ofWang.includes(name)));
  await press("reset");
  await isAsChosen(first);
  assert.equal(await count(page, "#counts tbody tr"), 2 * names.length); // tables show all subjects
}

/** The page shows what root parity misses beyond its contract, and an example, but calls it no failure. */
export async function showsWhatIsBeyondAContract(browser) {
  const page = await open(browser, makeReport("beyond", ["--cases", "4000", "--family", "small-integer", "--subject", "wang,parity", "--beyond-contract"]));
  assert.equal(jsonOf("beyond").headline.clean, true);
  assert.equal(await count(page, "#scorecard .verdict.bad"), 0);
  const last = page.locator("#scorecard .verdict").last();
  assert.match(await last.textContent(), /^–parity \(beyond contract\).*[1-9]\d* of [1-9]/);
  assert.equal(await last.locator("button.copy").count(), 1);
}

/**
 * The first chart shows every subject. If there are more subjects than colours, the subjects without failures
 * are chosen first.
 */
export async function drawsManySubjectsWithoutALadder(browser) {
  const defects = ["D2*0.01", "D2*0", "S*0", "vv", "proximity", "psi*0", "rho*0", "lambda2*0"].map((name) => `defect:${name}`);
  const names = [...defects, ..."wang,wang-eps,wang-plain,wang-tight,basic,basic-plain,exact,adaptive".split(",")];
  const page = await open(browser, makeReport("plain", ["--cases", "700", "--seed", "2", "--subject", names.join(",")]));
  const { verdicts } = jsonOf("plain");
  const chosen = () => page.locator("#picker input:checked").evaluateAll((all) => all.map((each) => each.value));
  const legend = async () => {
    await page.waitForSelector("body[data-drawn]");
    return page.locator("#error-time .role-legend-label text").allTextContents();
  };
  const points = () => count(page, "#error-time .concat_1_group .mark-symbol.role-mark path");
  const all = await points();
  assert.equal((await chosen()).length, 12);
  const clean = verdicts.filter((each) => each.clean).map((each) => each.subject);
  assert.ok(clean.length >= 5);
  for (const name of clean) assert.ok((await chosen()).includes(name), name);
  assert.deepEqual(new Set(await legend()), new Set(names));
  const labels = await page.locator("#error-time .concat_1_group .mark-text.role-mark text").allTextContents();
  for (const name of names) assert.ok(labels.includes(name), name);
  await page.click("#picker summary");
  for (const button of ["none", "all"]) {
    await page.locator("#picker button", { hasText: new RegExp(`^${button}$`) }).click();
    assert.deepEqual(new Set(await legend()), new Set(names));
    assert.equal(await points(), all);
  }
}

/**
 * The page draws a report with a precision ladder (one CCD in several scalar types), with subjects outside
 * any ladder, and with a scene.
 */
export async function drawsAMixOfRuns(browser) {
  run("scene", "spikes@100", "--subject", "wang,wang-time", "--db", "spikes.db");
  run("report", "many.db", "plain.db", "spikes.db", "-o", "mixed");
  const page = await open(browser, pageOf("mixed"));
  const { subjects, left_out, ladder } = jsonOf("mixed").error_against_time;
  assert.ok(ladder && subjects["defect:vv"].farthest_over_B === null);
  assert.deepEqual(left_out, ["wang-time"]);
  assert.match(await page.textContent("#error-time-others"), /: wang-time\.$/);
  assert.ok(await count(page, "#error-time .mark-symbol.role-mark path") > Object.keys(subjects).length);
}
