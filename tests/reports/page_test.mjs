// Opens reports in Chromium as a user does, and checks what is drawn. Usage: page_test.mjs NEARMISS
import { chromium } from "../../reports/page/node_modules/playwright-core/index.mjs";
import { hasNoBarriers, staysQuickWithManyFindings } from "./page/access.mjs";
import { showsAClaimOfNoDistanceThatIsRefuted, showsSweeps, showsSubjectsWithTheNamesOfMembers, showsASingleValueBesideASweep, showsSweepsOfWhatIsNeverWrong, showsValuesOfOptions, showsWhatDecides, showsWhereCollisionsAreMissed } from "./page/charts.mjs";
import { showsFindings, showsStandardError, showsVersions, showsVerticesAndEdges, showsThatNothingWasFound, showsTheBaseline, showsWhatIsNewSinceTheBaseline } from "./page/findings.mjs";
import { answersBeforeScrolling } from "./page/first_screen.mjs";
import { showsTheNights } from "./page/history.mjs";
import { showsTheLadderAndTheAudit } from "./page/ladder.mjs";
import { showsSceneStepsAndMeshes, showsScenes, showsSimulations } from "./page/scenes.mjs";
import { everyReportFollowsItsSchema } from "./page/schema.mjs";
import { removeFolder } from "./page/session.mjs";
import { drawsAMixOfRuns, drawsManySubjectsWithoutALadder, showsAChoiceOfManySubjects, showsWhatIsBeyondAContract } from "./page/subjects.mjs";
import { fitsEveryMedium, showsEnvironments, showsThePowerOfDetection } from "./page/tables.mjs";
import { namesEveryStripOfTimes, showsSeparations, showsTimesOfImpact, showsWhichTimesAreLate } from "./page/times.mjs";

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
try {
  await showsFindings(browser);
  await showsVerticesAndEdges(browser);
  await showsThatNothingWasFound(browser);
  await showsStandardError(browser);
  await showsVersions(browser);
  await showsTheBaseline(browser);
  await showsWhatIsNewSinceTheBaseline(browser);
  await showsTheNights(browser);
  await showsTimesOfImpact(browser);
  await showsSeparations(browser);
  await showsWhichTimesAreLate(browser);
  await namesEveryStripOfTimes(browser);
  await showsSweeps(browser);
  await showsASingleValueBesideASweep(browser);
  await showsSweepsOfWhatIsNeverWrong(browser);
  await showsSubjectsWithTheNamesOfMembers(browser);
  await showsValuesOfOptions(browser);
  await showsAClaimOfNoDistanceThatIsRefuted(browser);
  await showsScenes(browser);
  await showsSceneStepsAndMeshes(browser);
  await showsSimulations(browser);
  await showsTheLadderAndTheAudit(browser);
  await showsWhatDecides(browser);
  await showsAChoiceOfManySubjects(browser);
  await drawsManySubjectsWithoutALadder(browser);
  await drawsAMixOfRuns(browser);
  await showsWhatIsBeyondAContract(browser);
  await showsThePowerOfDetection(browser);
  await showsEnvironments(browser);
  await showsWhereCollisionsAreMissed(browser);
  await answersBeforeScrolling(browser);
  await fitsEveryMedium(browser);
  await staysQuickWithManyFindings(browser);
  await hasNoBarriers(browser);
  everyReportFollowsItsSchema();
} finally {
  await browser.close();
  removeFolder();
}
