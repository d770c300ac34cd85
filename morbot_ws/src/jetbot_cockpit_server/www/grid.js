// The grid in metres, with a scale.

const MIN_CELL = 48; // pixels

// Returns the smallest of 0.1, 0.2, 0.5, 1, 2, 5 ... m that is wide enough to see.
export function cellSize(scale) {
  for (let power = 0.1; ; power *= 10) {
    for (const size of [power, 2 * power, 5 * power]) if (size * scale >= MIN_CELL) return size;
  }
}

export function drawGrid(context, viewport, colors) {
  const cell = cellSize(viewport.scale);
  const [left, top] = viewport.toMetres(0, 0);
  const [right, bottom] = viewport.toMetres(viewport.width, viewport.height);
  Object.assign(context, { font: "11px system-ui, sans-serif", lineWidth: 1, fillStyle: colors.muted });
  for (let n = Math.ceil(left / cell); n * cell <= right; n += 1) {
    const across = Math.round(viewport.toPixels(n * cell, 0)[0]) + 0.5;
    line(context, [across, 0], [across, viewport.height], n === 0 ? colors.axis : colors.grid);
  }
  for (let n = Math.ceil(bottom / cell); n * cell <= top; n += 1) {
    const down = Math.round(viewport.toPixels(0, n * cell)[1]) + 0.5;
    line(context, [0, down], [viewport.width, down], n === 0 ? colors.axis : colors.grid);
  }
  drawScale(context, viewport, cell, colors);
}

function drawScale(context, viewport, cell, colors) {
  const [left, length] = [14.5, Math.round(cell * viewport.scale)];
  const down = Math.round(viewport.height - viewport.covered.below) - 9.5; // above the legend
  Object.assign(context, { strokeStyle: colors.text, lineWidth: 1.5, fillStyle: colors.text, textAlign: "center" });
  context.beginPath();
  for (const [x, y] of [[left, down - 5], [left, down], [left + length, down], [left + length, down - 5]]) {
    context.lineTo(x, y);
  }
  context.stroke();
  context.fillText(`${Number(cell.toPrecision(1))} m`, left + length / 2, down - 5);
}

function line(context, from, to, color) {
  context.strokeStyle = color;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}
