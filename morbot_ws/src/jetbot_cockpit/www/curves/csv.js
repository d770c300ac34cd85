// The drives as a table: a row for each time at which something was reported, with the numbers as they came.

import { COLUMNS } from "./drive.js";

// Returns the text of a CSV file. drives: see drive.js
export function toCsv(drives) {
  const names = [...new Set(drives.flatMap(({ prints }) => [...prints.keys()]))];
  const header = ["drive", "time (s)", "stamp (s)", ...Object.values(COLUMNS).flat(), ...names.map(quoted)];
  const lines = [...drives].reverse().flatMap((drive) => rows(drive, names, header.length));
  return [header, ...lines].map((row) => `${row.join(",")}\r\n`).join("");
}

// Returns the rows of a drive, by time; cells without a value are empty.
function rows(drive, names, width) {
  const table = new Map();
  let column = 3;
  const enter = (track, count) => {
    for (let index = 0; index < (track?.count ?? 0); index += 1) {
      if (track.isGap(index)) continue;
      const stamp = track.at(index);
      const time = (stamp - drive.start).toFixed(3);
      if (!table.has(stamp)) table.set(stamp, [drive.number, time, stamp, ...Array(width - 3)]);
      table.get(stamp).splice(column, count, ...track.row(index).slice(1, 1 + count));
    }
    column += count;
  };
  for (const [topic, each] of Object.entries(COLUMNS)) enter(drive.tracks[topic], each.length);
  for (const name of names) enter(drive.prints.get(name), 1);
  return [...table.values()].sort((one, other) => one[2] - other[2]);
}

// Returns a name that a spreadsheet shows, and never calculates.
function quoted(name) {
  return `"${name.replace(/^(?=[=+\-@\t\r\n])/, "'").replaceAll('"', '""')}"`;
}
