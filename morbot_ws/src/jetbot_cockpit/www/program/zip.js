// Packs files into a zip, not compressed, with the rights that Unix gives them.

const [UTF8, MADE_BY_UNIX, VERSION, DATE] = [0x800, 3 << 8 | 20, 20, 1 << 5 | 1]; // DATE: 1 January 1980
const CRC = Uint32Array.from({ length: 256 }, (_, byte) => {
  let sum = byte;
  for (let bit = 0; bit < 8; bit += 1) sum = sum & 1 ? sum >>> 1 ^ 0xedb88320 : sum >>> 1;
  return sum;
});

// Returns the zip as a Blob. files: { name, text, mode }, mode as of chmod
export function zip(files) {
  const encoder = new TextEncoder();
  const parts = [], entries = [];
  let offset = 0;
  for (const { name, text, mode } of files) {
    const [path, data] = [encoder.encode(name), encoder.encode(text)];
    const both = [UTF8, 0, 0, DATE, [crc32(data)], [data.length], [data.length], path.length, 0];
    const header = bytes([0x04034b50], VERSION, ...both);
    const rights = (0o100000 | mode) << 16;
    entries.push(bytes([0x02014b50], MADE_BY_UNIX, VERSION, ...both, 0, 0, 0, [rights], [offset]), path);
    parts.push(header, path, data);
    offset += header.length + path.length + data.length;
  }
  const size = entries.reduce((sum, { length }) => sum + length, 0);
  const end = bytes([0x06054b50], 0, 0, files.length, files.length, [size], [offset], 0);
  return new Blob([...parts, ...entries, end]);
}

// Returns the numbers in 2 bytes each, those in brackets in 4.
function bytes(...numbers) {
  return Uint8Array.from(numbers.flatMap((number) => Array.isArray(number)
    ? [number[0], number[0] >>> 8, number[0] >>> 16, number[0] >>> 24] : [number, number >>> 8]));
}

function crc32(data) {
  return ~data.reduce((sum, byte) => CRC[(sum ^ byte) & 255] ^ sum >>> 8, ~0) >>> 0;
}
