// Tests the picker for many subjects, and the charts that it redraws.
import assert from "node:assert/strict";
import { count, jsonOf, makeReport, open } from "./session.mjs";

/** Failed subjects and the Pareto front come first. A change redraws the charts with a row or a line for each subject. */
export async function showsAChoiceOfManySubjects(browser) {
  const names = "wang:float,wang:p40,wang:p64,wang-tight:float,wang-tight:p40,wang,wang-tight,basic,basic-plain,exact,adaptive".split(",");
  const page = await open(browser, makeReport("many", ["--cases", "600", "--search", "--subject", names.join(",")]));
  const { verdicts, error_against_time, subjects } = jsonOf("many");
  const bad = verdicts.filter((each) => !each.clean).map((each) => each.subject);
  assert.ok(bad.includes("basic") && names.length - bad.length > 8);
  assert.equal(await page.locator(".verdict.bad").first().isVisible(), true);
  assert.equal(await page.locator("#verdicts details div.verdict").first().isVisible(), false);
  await page.click("#verdicts summary");
  assert.equal(await count(page, "div.verdict:visible"), names.length);

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
  assert.equal(first.length, 8);
  const front = [...(error_against_time.ladder ?? error_against_time).front_by_distance, ...error_against_time.front_by_rate, ...error_against_time.front_by_earliness];
  for (const name of [...bad, ...front].slice(0, 8)) assert.ok(first.includes(name), name);
  await isAsChosen(first);
  assert.equal(await count(page, "#picker-legend .swatch"), 8);

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
  await press("wang"); // before all charts are drawn
  await isAsChosen(names.filter((name) => !ofWang.includes(name)));
  await press("reset");
  await isAsChosen(first);
  assert.equal(await count(page, "#counts tbody tr"), 2 * names.length); // tables are complete
  await page.close();
}

export async function drawsManySubjectsWithoutALadder(browser) {
  const names = "wang,wang-eps,wang-plain,wang-tight,basic,basic-plain,exact,adaptive,defect:vv,defect:proximity".split(",");
  const page = await open(browser, makeReport("plain", ["--cases", "500", "--subject", names.join(",")]));
  const legend = async () => {
    await page.waitForSelector("body[data-drawn]");
    return page.locator("#error-time .role-legend-label text").allTextContents();
  };
  const points = () => count(page, "#error-time .concat_1_group .mark-symbol.role-mark path");
  const all = await points();
  assert.equal(new Set(await legend()).size, 9); // the initial selection, and all other subjects in one colour
  assert.ok((await legend()).includes("others"));
  await page.click("#picker summary");
  for (const [button, labels] of [["none", ["others"]], ["all", names]]) {
    await page.locator("#picker button", { hasText: new RegExp(`^${button}$`) }).click();
    assert.deepEqual(new Set(await legend()), new Set(labels));
    assert.equal(await points(), all);
  }
  await page.close();
}
