// Checks that every listed defect, of the oracle and of ccd/, can be applied to the current sources, and
// changes them.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { source } from './copy.mjs';
import { applied, filesOf, readDefects } from './list.mjs';

/** Why a defect cannot be applied, or undefined. */
function complaint(defect) {
  for (const file of filesOf(defect)) {
    const text = readFileSync(path.join(source, file), 'utf8');
    try {
      if (applied(defect, file, text) === text) return `${defect.name}: changes nothing`;
    } catch (error) {
      return error.message;
    }
  }
  return undefined;
}

const defects = [...readDefects(), ...readDefects(path.join(source, 'fuzz/subjects/defects'), 'ccd/wang')];
const complaints = defects.map(complaint).filter(Boolean);
for (const each of complaints) console.error(each);
console.log(`${defects.length - complaints.length} of ${defects.length} defects apply`);
process.exitCode = complaints.length > 0 ? 1 : 0;
