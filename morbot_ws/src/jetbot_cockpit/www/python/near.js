// The name that a person meant.

const SAME = 0.5; // less than one letter apart: only capital letters differ

// Returns the known name that is nearest to this one, or null: long names may have two wrong letters, short ones none.
/** @param {string} name @param {Iterable<string>} known @returns {string | null} */
export function near(name, known) {
  let [best, least] = [/** @type {string | null} */ (null), name.length < 3 ? SAME : name.length < 6 ? 1 : 2];
  for (const each of known) {
    const apart = each.toLowerCase() === name.toLowerCase() ? SAME : distance(name, each);
    if (each !== name && (apart < least || (apart === least && !best))) [best, least] = [each, apart];
  }
  return best;
}

// Returns how many letters are wrong, missing, too many, or swapped with the next (optimal string alignment).
function distance(one, other) {
  const rows = [Array.from({ length: other.length + 1 }, (_, column) => column)];
  for (let row = 1; row <= one.length; row++) {
    rows[row] = [row];
    for (let column = 1; column <= other.length; column++) {
      const same = one[row - 1] === other[column - 1];
      const swapped = one[row - 1] === other[column - 2] && one[row - 2] === other[column - 1];
      rows[row][column] = Math.min(rows[row - 1][column] + 1, rows[row][column - 1] + 1,
                                   rows[row - 1][column - 1] + (same ? 0 : 1),
                                   swapped ? rows[row - 2][column - 2] + 1 : Infinity);
    }
  }
  return rows[one.length][other.length];
}
