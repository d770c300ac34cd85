// Packs files into a text that unpacks itself: sh NAME.txt. A zip does not arrive: browsers hold it back where the page
// comes by plain http from another computer. A text, they keep.

// Returns the text. folder: what it makes; files: { name, text, executable }; their names need no quotes in a shell
export function archive(folder, files) {
  return [
    `# This text unpacks itself, here or into the named folder: sh ${folder}.txt FOLDER`,
    "set -e",
    'cd "${1:-.}"',
    `mkdir ${folder}`, // ends here if it exists: nothing is overwritten
    `cd ${folder}`,
    ...files.flatMap(unpacking),
    "",
  ].join("\n");
}

// No line of a file is a command: each begins with |, which sed removes.
function unpacking({ name, text, executable }) {
  const lines = text.replace(/\n$/, "").split("\n");
  const folder = name.replace(/[^/]*$/, "");
  return [
    ...folder ? [`mkdir -p ${folder}`] : [],
    `sed 's/^|//' > ${name} <<'END'`,
    ...lines.map((line) => `|${line}`),
    "END",
    ...executable ? [`chmod +x ${name}`] : [],
  ];
}
