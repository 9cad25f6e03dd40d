// Tests scenes: their pairs, steps and meshes.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { count, folder, open, pageOf, run } from "./session.mjs";

export async function showsScenes(browser) {
  const obj = (z) => `v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 ${z}\nv 1 0.5 ${-z}\nv 0.5 1 ${z}\nf 1 2 3\nf 4 5 6\n`;
  writeFileSync(join(folder, "start.obj"), obj(1));
  writeFileSync(join(folder, "end.obj"), obj(-1));
  run("scene", "start.obj", "end.obj", "--db", "scene.db");
  run("report", "scene.db", "-o", "scene");
  const page = await open(browser, pageOf("scene"));
  assert.equal(await count(page, "#scenes tbody tr"), 2);
  assert.match(await page.locator("#scenes tbody tr").first().textContent(), /^startvt12/);
  assert.equal(await count(page, "#scene-subjects tbody tr"), 2);
  assert.equal(await page.isVisible("#scene-steps"), false);
  assert.equal(await count(page, "canvas.mesh"), 1);
}

export async function showsSimulations(browser) {
  run("simulate", "cloths@100", "--subject", "bullet,exact", "--steps", "25", "--db", "simulated.db");
  run("report", "simulated.db", "-o", "simulated");
  const page = await open(browser, pageOf("simulated"));
  assert.equal(await count(page, "#simulations tbody tr"), 2);
  assert.match(await page.locator("#simulations tbody tr").first().textContent(), /^cloths@100bullet25/);
  assert.ok((await count(page, "#simulations tbody tr:first-child td.bad")) >= 2);
  assert.equal(await count(page, "#simulations tbody tr:last-child td.bad"), 0);
  assert.equal(await count(page, "#simulated-steps .mark-line path"), 4 * 2);
  assert.equal(await count(page, "#simulation-pictures canvas.mesh"), 2);
  const mesh = page.locator("#simulation-pictures canvas.mesh").first();
  assert.ok((await mesh.boundingBox()).width >= 600);
  const before = await mesh.evaluate((canvas) => canvas.toDataURL());
  await page.getByRole("button", { name: "next tangle" }).first().click();
  assert.notEqual(await mesh.evaluate((canvas) => canvas.toDataURL()), before);
  assert.match(await page.locator("#simulation-pictures .mesh-legend").first().textContent(), /tangled \(\d+ primitives?\)/);
  assert.equal(await page.isVisible("#scenes-section"), false);
}

export async function showsSceneStepsAndMeshes(browser) {
  for (const scene of ["mat@300", "hair@100"])
    run("scene", scene, "--subject", "basic,wang", "--bound", "pair,scene", "--db", `${scene}.db`);
  run("report", "mat@300.db", "hair@100.db", "-o", "scenes");
  const page = await open(browser, pageOf("scenes"));
  assert.equal(await count(page, "#scenes tbody tr"), 4); // 2 scenes, 2 kinds
  assert.equal(await count(page, "#scene-subjects tbody tr"), 6);
  await page.check("#by-step");
  assert.equal(await count(page, "#scenes tbody tr"), 2 * (39 + 30));
  assert.equal(await count(page, "#scene-subjects tbody tr"), 3 * (39 + 30));
  assert.equal(await count(page, "#scene-error-time .mark-symbol.role-mark path"), 6);
  assert.equal(await count(page, "#scene-steps .mark-line path"), 2 * (1 + 1 + 3 + 3));
  const mesh = page.locator("canvas.mesh").first();
  const drawn = () => mesh.evaluate((canvas) => canvas.toDataURL());
  const seen = [await drawn()];
  const changes = async (act) => {
    await act();
    seen.push(await drawn());
    assert.equal(new Set(seen).size, seen.length);
  };
  await mesh.scrollIntoViewIfNeeded();
  const box = await mesh.boundingBox();
  await changes(async () => {
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 180, box.y + 120, { steps: 4 });
    await page.mouse.up();
  });
  await mesh.focus();
  await changes(() => page.keyboard.press("ArrowLeft"));
  await changes(() => page.getByRole("button", { name: "larger" }).first().click());
  await changes(() => page.getByRole("slider").first().fill("0"));
  assert.match(await page.locator(".mesh-legend").first().textContent(), /collides \(\d+ primitives?\)/);
  run("report", "scene.db", "mat@300.db", "-o", "two-scenes");
  const two = await open(browser, pageOf("two-scenes"));
  const names = await two.locator(".mesh-controls select").first().locator("option").allTextContents();
  assert.ok(names.length > 2 && names.some((name) => name.startsWith("mat")), "pictures of several steps");
  for (const name of names) {
    await two.locator(".mesh-controls select").first().selectOption(name);
    assert.equal(await two.locator(".scene-picture strong").textContent(), name);
  }
}
