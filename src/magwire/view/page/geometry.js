// Meshes of lumen, wire and arrows, and the wall's pressure, from arrays of points [m] and forces [N].
"use strict";
((parts) => {
  const { add, sub, scale, dot, cross, norm, unit, at, across } = parts.algebra;
  const SIDES = 28; // of the lumen
  const ROUND = 12; // of the wire
  const MOST_RINGS = 1800; // of all branches

  // Unit tangents of a line of points.
  function tangents(points) {
    const last = points.length - 1;
    return points.map((_, k) => unit(sub(points[Math.min(k + 1, last)], points[Math.max(k - 1, 0)])));
  }

  // Two unit normals at each point, carried along without twisting.
  function frames(points) {
    let beside = across(tangents(points)[0]);
    return tangents(points).map((along) => {
      beside = unit(sub(beside, scale(along, dot(beside, along))));
      return { along, beside, over: cross(along, beside) };
    });
  }

  // Rings around a line: positions and normals, SIDES or so for each point.
  function rings(points, radii, sides) {
    const positions = new Float32Array(3 * sides * points.length);
    const normals = new Float32Array(positions.length);
    frames(points).forEach(({ beside, over }, ring) => {
      for (let side = 0; side < sides; side++) {
        const angle = (2 * Math.PI * side) / sides;
        const normal = add(scale(beside, Math.cos(angle)), scale(over, Math.sin(angle)));
        normals.set(normal, 3 * (ring * sides + side));
        positions.set(add(points[ring], scale(normal, radii[ring])), 3 * (ring * sides + side));
      }
    });
    return { positions, normals };
  }

  function ribbons(count, sides, offset) {
    const indices = [];
    for (let ring = 0; ring + 1 < count; ring++)
      for (let side = 0; side < sides; side++) {
        const a = offset + ring * sides + side;
        const b = offset + ring * sides + ((side + 1) % sides);
        indices.push(a, b, a + sides, b, b + sides, a + sides);
      }
    return indices;
  }

  function inside(branch, x, y, z, slack) {
    for (let k = 0; k < branch.radii.length; k++) {
      const [px, py, pz] = branch.points[k];
      const r = slack * branch.radii[k];
      const d = (x - px) * (x - px) + (y - py) * (y - py) + (z - pz) * (z - pz);
      if (d < r * r) return true;
    }
    return false;
  }

  function finer(branch, most) {
    const { points, radii } = branch;
    const length = [0];
    for (let k = 1; k < points.length; k++) length.push(length[k - 1] + norm(sub(points[k], points[k - 1])));
    const whole = length[points.length - 1];
    const slim = Math.min(...radii);
    const count = Math.max(2, Math.min(most, Math.ceil(whole / (0.2 * slim)) + 1));
    const found = { points: [], radii: [] };
    for (let n = 0, k = 0; n < count; n++) {
      const s = (whole * n) / (count - 1);
      while (k + 2 < points.length && length[k + 1] < s) k++;
      const t = Math.min(1, (s - length[k]) / (length[k + 1] - length[k] || 1));
      found.points.push(add(scale(points[k], 1 - t), scale(points[k + 1], t)));
      found.radii.push((1 - t) * radii[k] + t * radii[k + 1]);
    }
    return found;
  }

  // The wall of all branches, without what lies inside of another one; with the area of each corner.
  function wall(branches) {
    const most = Math.floor(MOST_RINGS / Math.max(branches.length, 1));
    const fine = branches.map((branch) => finer(branch, Math.max(most, 24)));
    const mesh = { positions: [], normals: [], indices: [], rings: [] };
    fine.forEach((branch, which) => {
      const offset = mesh.positions.length / 3;
      const { positions, normals } = rings(branch.points, branch.radii, SIDES);
      const others = fine.filter((_, other) => other !== which);
      const before = fine.slice(0, which);
      const hidden = new Uint8Array(positions.length / 3);
      for (let v = 0; v < hidden.length; v++) {
        const [x, y, z] = at(positions, v);
        // What two branches share is drawn once, by the first of them.
        hidden[v] = others.some((other) => inside(other, x, y, z, before.includes(other) ? 1.004 : 0.985));
      }
      for (const value of positions) mesh.positions.push(value);
      for (const value of normals) mesh.normals.push(value);
      const all = ribbons(branch.points.length, SIDES, 0);
      for (let k = 0; k < all.length; k += 3) {
        const [a, b, c] = [all[k], all[k + 1], all[k + 2]];
        if (hidden[a] && hidden[b] && hidden[c]) continue;
        mesh.indices.push(a + offset, b + offset, c + offset);
      }
      branch.points.forEach((centre, ring) =>
        mesh.rings.push({
          centre,
          radius: branch.radii[ring],
          far: 1.3 * branch.radii[ring],
          first: offset + ring * SIDES,
          count: SIDES,
          begins: ring === 0,
        }),
      );
    });
    mesh.positions = new Float32Array(mesh.positions);
    mesh.normals = new Float32Array(mesh.normals);
    mesh.indices = new Uint32Array(mesh.indices);
    mesh.areas = areas(mesh);
    return mesh;
  }

  // A wall that is a surface: its corners, grouped by the point of the centrelines that each is nearest to,
  // are in the order of these groups. rings: x, y, z and radius there, how many corners are in the group,
  // how far the farthest is, and whether a branch begins.
  function surface({ positions, indices, rings }) {
    const mesh = { positions, indices: Uint32Array.from(indices), rings: [], sheet: true };
    for (let k = 0, first = 0; k < rings.length; k += 7) {
      const [x, y, z, radius, count, far, begins] = rings.subarray(k, k + 7);
      mesh.rings.push({ centre: [x, y, z], radius, far, first, count, begins: begins > 0 });
      first += count;
    }
    mesh.normals = new Float32Array(positions.length);
    for (let k = 0; k < mesh.indices.length; k += 3) {
      const corners = mesh.indices.subarray(k, k + 3);
      const [a, b, c] = [...corners].map((v) => at(positions, v));
      const across = cross(sub(b, a), sub(c, a));
      for (const v of corners) for (let i = 0; i < 3; i++) mesh.normals[3 * v + i] += across[i];
    }
    for (let v = 0; v < positions.length / 3; v++) {
      const size = norm(at(mesh.normals, v)) || 1;
      for (let i = 0; i < 3; i++) mesh.normals[3 * v + i] /= size;
    }
    mesh.areas = areas(mesh);
    return mesh;
  }

  // A wall that moves with the tissue as magwire.contact.motion says: moves the mesh to where it is at a time.
  // A displacement is of where the tissue is, not of where it rests: found by going there and back.
  class Moving {
    constructor(mesh, motions, entrance) {
      const rest = mesh.positions;
      mesh.positions = rest.slice();
      const centres = mesh.rings.map(({ centre }) => centre);
      const corners = Array.from({ length: rest.length / 3 }, (_, v) => at(rest, v));
      Object.assign(this, { mesh, corners, centres, motions, entrance });
    }

    gone(point, time) {
      let there = point;
      for (let pass = 0; pass < 40; pass++) {
        const before = there;
        there = point;
        for (const { amplitude, period, ramp } of this.motions) {
          const s = Math.min(1, norm(sub(before, this.entrance)) / ramp);
          const rise = s * s * s * (10 - 15 * s + 6 * s * s);
          there = add(there, scale(amplitude, rise * Math.sin((Math.PI * time) / period) ** 2));
        }
        if (norm(sub(there, before)) < 1e-9) break;
      }
      return there;
    }

    to(time) {
      const { mesh, corners, centres } = this;
      corners.forEach((corner, v) => mesh.positions.set(this.gone(corner, time), 3 * v));
      mesh.rings.forEach((ring, k) => (ring.centre = this.gone(centres[k], time)));
    }
  }

  // A third of the triangles around each corner [m^2].
  function areas({ positions, indices }) {
    const found = new Float32Array(positions.length / 3);
    for (let k = 0; k < indices.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => at(positions, indices[k + i]));
      const third = norm(cross(sub(b, a), sub(c, a))) / 6;
      for (let i = 0; i < 3; i++) found[indices[k + i]] += third;
    }
    return found;
  }

  // Pressure at the corners of the wall [Pa]. Each node's force goes to where it presses, spread over a
  // disc; its integral over the wall is the force again, whatever the mesh.
  function pressure(mesh, points, forces, { skin, spread }) {
    const found = new Float32Array(mesh.areas.length);
    const weights = new Float32Array(mesh.areas.length);
    for (let node = 0; node < points.length / 3; node++) {
      const force = at(forces, node);
      const size = norm(force);
      if (!(size > 0)) continue;
      const [x, y, z] = sub(at(points, node), scale(force, skin / size));
      const near = [];
      let sum = 0;
      for (const { centre, radius, far, first, count } of mesh.rings) {
        const reach = spread * radius;
        if (Math.hypot(centre[0] - x, centre[1] - y, centre[2] - z) > far + reach) continue;
        for (let v = first; v < first + count; v++) {
          const d = Math.hypot(mesh.positions[3 * v] - x, mesh.positions[3 * v + 1] - y, mesh.positions[3 * v + 2] - z);
          if (d >= reach || mesh.areas[v] === 0) continue;
          const part = 1 - (d / reach) ** 2;
          weights[v] = part * part;
          sum += weights[v] * mesh.areas[v];
          near.push(v);
        }
      }
      for (const v of near) found[v] += (size * weights[v]) / sum;
    }
    return found;
  }

  // A growing list of corners with normals and colours, for what is drawn anew in each picture.
  class Solid {
    constructor() {
      this.positions = [];
      this.normals = [];
      this.colours = [];
      this.indices = [];
    }

    // A tube along points; colours of four numbers, one for each point. Ends are closed: round, or flat if
    // steps is 0.
    tube(points, radii, colours, sides = ROUND, steps = 4) {
      if (points.length < 2) return;
      const offset = this.positions.length / 3;
      const { positions, normals } = rings(points, radii, sides);
      for (const value of positions) this.positions.push(value);
      for (const value of normals) this.normals.push(value);
      for (const colour of colours) for (let side = 0; side < sides; side++) this.colours.push(...colour);
      for (const index of ribbons(points.length, sides, offset)) this.indices.push(index);
      const along = tangents(points);
      const last = points.length - 1;
      this.cap(points[0], scale(along[0], -1), radii[0], colours[0], sides, steps);
      this.cap(points[last], along[last], radii[last], colours[last], sides, steps);
    }

    // The end of a tube: half a ball in some steps, or a disc.
    cap(centre, along, radius, colour, sides, steps) {
      const beside = across(along);
      const over = cross(along, beside);
      const offset = this.positions.length / 3;
      const rises = steps ? Array.from({ length: steps + 1 }, (_, step) => (0.5 * Math.PI * step) / steps) : [0, 1];
      rises.forEach((rise, step) => {
        for (let side = 0; side < sides; side++) {
          const turn = (2 * Math.PI * side) / sides;
          const round = add(scale(beside, Math.cos(turn)), scale(over, Math.sin(turn)));
          const normal = steps ? add(scale(round, Math.cos(rise)), scale(along, Math.sin(rise))) : along;
          this.positions.push(...add(centre, scale(steps ? normal : round, steps || !step ? radius : 0)));
          this.normals.push(...normal);
          this.colours.push(...colour);
        }
      });
      for (const index of ribbons(rises.length, sides, offset)) this.indices.push(index);
    }

    // An arrow of some thickness from a point.
    arrow(from, by, radius, colour) {
      const length = norm(by);
      if (!(length > 0)) return;
      const along = unit(by);
      const head = Math.min(5 * radius, 0.6 * length);
      const neck = add(from, scale(along, length - head));
      const tip = add(from, by);
      const thin = Math.min(radius, 0.2 * head);
      this.tube([from, neck], [thin, thin], [colour, colour], 8, 0);
      this.tube([neck, tip], [0.45 * head, 1e-3 * thin], [colour, colour], 14, 0);
    }
  }

  parts.geometry = { wall, surface, Moving, pressure, Solid, tangents };
})((window.magwireParts ??= {}));
