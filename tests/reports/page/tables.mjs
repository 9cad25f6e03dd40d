// Tests the tables of power and of environments, and the page in the dark theme, on a phone and on paper.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { count, folder, makeReport, open, pageOf, run } from "./session.mjs";

export async function showsThePowerOfDetection(browser) {
  run("power", "--subject", "defect:vv,defect:proximity,wang", "--way", "families,search", "--time", "2s", "--json", "power.json");
  const page = await open(browser, makeReport("powerful", ["--cases", "10"], ["--power", "power.json"]));
  assert.equal(await count(page, "#power tbody tr"), 3);
  assert.match(await page.locator("#power tbody tr").first().textContent(), /^defect:vv[\d.e-]+ s, [\d,]+/);
}

export async function showsEnvironments(browser) {
  const row = { subject: "wang", compiler: "g++ 12.2.0", flags: "-O2", mode: "upward", queries: 1000, collisions: 500, missed: 0,
    false_positives: 10, refuted_bounds: 0, faults: 0, first: null };
  const broken = { ...row, flags: "-O2 -ffast-math", missed: 3, first: "false-negative scale:1:29" };
  writeFileSync(join(folder, "environments.json"), JSON.stringify([row, broken]));
  const page = await open(browser, makeReport("environments", ["--cases", "10"], ["--environments", "environments.json"]));
  assert.deepEqual(await page.locator("#environments tbody tr").allTextContents(),
    ["wangg++ 12.2.0-O2upward1,00050001000keeps it",
      "wangg++ 12.2.0-O2 -ffast-mathupward1,00050031000missesfalse-negative scale:1:29"]);
  assert.equal(await count(page, "#environments td.bad"), 2);
}

/**
 * The page shows everything in the dark theme, on a phone and on paper, and nothing extends beyond the page.
 */
export async function fitsEveryMedium(browser) {
  const url = pageOf("found");
  for (const each of [url, pageOf("timed"), pageOf("night")])
    for (const options of [{ colorScheme: "dark" }, { viewport: { width: 390, height: 800 } }]) {
      const page = await open(browser, each, options);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "sticks out");
    }
  for (const each of [url, pageOf("eleven")]) {
    const page = await open(browser, each);
    const paper = await page.pdf({ format: "A4" });
    assert.ok(paper.length > 50000);
    const sheets = paper.toString("latin1").match(/\/Type\s*\/Page\b(?!s)/g).length;
    assert.ok(sheets <= 12, `${sheets} sheets`);
  }
}
