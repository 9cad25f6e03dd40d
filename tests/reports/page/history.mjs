// Tests the page about many nightly campaigns.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { axeViolations } from "./access.mjs";
import { count, folder, nearmiss, open, pageOf, run } from "./session.mjs";

/**
 * In the first and the third of three nights, the subject `mine` is a textbook CCD, which misses collisions.
 * In the second night, `mine` is an exact CCD.
 */
export async function showsTheNights(browser) {
  const stores = [];
  for (const [i, subject] of ["mine=basic,wang", "mine=exact", "mine=basic"].entries()) {
    const night = `nights/2026-11-0${i + 1}`;
    run("fuzz", "--subject", subject, "--family", "parallel,uniform", "--kind", "vt,ee", "--cases", "3000", "--seed", String(i), "--db", `${i}.db`);
    run("report", `${i}.db`, "-o", `${night}/report`, ...stores.flatMap((each) => ["--baseline", each]));
    stores.push(`${i}.db`);
  }
  const said = execFileSync(nearmiss, ["history", "nights"], { cwd: folder, encoding: "utf8" });
  assert.match(said, /^2026-11-01 +FAIL +3,000$/m);
  for (const options of [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 800 } }]) {
    const page = await open(browser, pageOf("nights"), options);
    assert.equal(await count(page, "#nights tbody tr"), 3);
    assert.deepEqual(await page.locator("#nights tbody tr").first().locator("td").first().allTextContents(), ["2026-11-03"]);
    assert.match(await page.locator("#nights tbody tr").nth(1).textContent(), /ways to fail gone/);
    assert.equal(await count(page, "#subjects .chart"), 8); // four charts for each of two subjects
    assert.ok(await count(page, "#ways tbody td.bad") > 0);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "sticks out");
    assert.deepEqual(await axeViolations(page), []);
  }
  const page = await open(browser, pageOf("nights"));
  await page.locator("#nights a").first().click();
  await page.waitForURL(/nights\/2026-11-03\/report\/index.html$/);
}
