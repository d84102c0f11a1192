// The numbers of the page: arrays that were packed by magwire.view.packing.
"use strict";
((parts) => {
  async function inflate(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer();
  }

  // Whole steps, as second differences along the first axis in zigzag, byte by byte.
  function summed(bytes, { shape, step }) {
    const count = bytes.length / 4;
    const found = new Int32Array(count);
    for (let k = 0; k < count; k++) {
      const z = bytes[k] | (bytes[count + k] << 8) | (bytes[2 * count + k] << 16) | (bytes[3 * count + k] << 24);
      found[k] = (z >>> 1) ^ -(z & 1);
    }
    const row = count / shape[0];
    for (let turn = 0; turn < 2; turn++) for (let k = row; k < count; k++) found[k] += found[k - row];
    return Float64Array.from(found, (value) => value * step);
  }

  // A flat array of an array's numbers; of "steps", those within half a step.
  async function unpack(packed) {
    const buffer = await inflate(packed.data);
    if (packed.kind === "steps") return summed(new Uint8Array(buffer), packed);
    return packed.kind === "float32" ? new Float32Array(buffer) : new Float64Array(buffer);
  }

  // A wall that is a surface, if there is one.
  async function unpackSurface(packed) {
    return packed && { positions: await unpack(packed.positions), indices: await unpack(packed.indices), rings: await unpack(packed.rings) };
  }

  // A run with its arrays unpacked and its branches as scenes take them.
  async function unpackRun(run) {
    const names = Object.keys(run.arrays);
    const unpacked = await Promise.all(names.map((name) => unpack(run.arrays[name])));
    const arrays = Object.fromEntries(names.map((name, k) => [name, unpacked[k]]));
    const lumen = await Promise.all(run.branches.map(unpack));
    const branches = lumen.map((rows) => {
      const made = { points: [], radii: [] };
      for (let k = 0; k < rows.length; k += 4) {
        made.points.push([rows[k], rows[k + 1], rows[k + 2]]);
        made.radii.push(rows[k + 3]);
      }
      return made;
    });
    const surface = await unpackSurface(run.surface);
    const width = 3 * run.wire.magnet.length;
    const row = (name, k) => arrays[name].subarray(width * k, width * (k + 1));
    return {
      ...run,
      arrays,
      branches,
      surface,
      count: arrays.time.length,
      points: (k) => row("position", k),
      forces: (k) => row("contact_force", k),
      field: (k) => [...arrays.field.subarray(3 * k, 3 * k + 3)],
    };
  }

  // Index of the record that is nearest to a time.
  function nearest(times, time) {
    let [low, high] = [0, times.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle;
    }
    return Math.abs(times[high] - time) < Math.abs(times[low] - time) ? high : low;
  }

  parts.data = { unpackRun, unpackSurface, nearest };
})((window.magwireParts ??= {}));
