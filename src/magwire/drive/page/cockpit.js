// The page as a whole: what is heard is shown, what hands do is said.
"use strict";
((parts) => {
  const { sub, norm } = parts.algebra;
  const SAY_EVERY = 100; // ms between two messages while something is held; the server lets go after 300
  const SLOW = 0.93; // rate of the clock below which the page says so
  const TURN = 1.2; // of the field by keys [rad/s]
  const RISE = 0.25; // of the largest field a second, by keys
  const SPREAD = 0.8; // as in scene.js
  const REWIND = 2; // seconds
  const HARDEST = 100; // newtons, with which no hand pushes a wire: a larger limit is a slip of the keys
  const WAYS = ["shaded", "shaded coarsely", "plain strokes"]; // as in scene.js

  class Cockpit {
    constructor(root) {
      this.root = root;
      this.find = (name) => root.querySelector(name);
      this.latencies = [];
      this.hands = new parts.Hands({ changed: (event) => this.hold(event), pressed: (key) => this.press(key) });
      this.gauge = new parts.Gauge(this.find(".gauge"));
      this.last = { feed: 0, twist: 0 };
      this.pace = new parts.Pace(() => this.hurry());
      this.pictures = 0;
      this.controls();
      this.live = new parts.Live((message) => this.hear(message));
      setInterval(() => this.hold(), SAY_EVERY / 2); // pictures may be slow; hands are not
      this.before = performance.now();
      const turn = (now) => {
        this.turn(now);
        requestAnimationFrame(turn);
      };
      requestAnimationFrame(turn);
    }

    hear(message) {
      if ("connected" in message) this.connected = message.connected;
      if (message.world) this.unpacked ??= this.unpack(message.world);
      if (message.role) this.role = message.role;
      if (message.said) this.notice(message.said);
      if (message.picture) {
        this.picture = message.picture;
        this.fresh = true;
      }
      if (message.report) this.report(message.report);
      this.status();
    }

    async unpack(world) {
      this.build({ ...world, surface: await parts.data.unpackSurface(world.surface) });
    }

    build(world) {
      this.world = world;
      this.find("h1").textContent = world.title || "magwire";
      this.camera = new parts.Camera();
      this.scene = new parts.Scene(this.find(".scene"), this.camera, true);
      const length = world.wire.length;
      this.scene.setWorld({ ...world, path: [[0, 0, 0], [length, 0, 0]] });
      this.most = world.largestField;
      this.scaled(world.limit);
      const pads = [["frontal", 0], ["lateral", 1]];
      const directions = parts.projections(this.scene);
      this.arms = pads.map(([name, k]) => new parts.Fluoroscopy(this.find(`.arm-${name}`), name, directions[k]));
      this.arms.forEach((arm) => arm.setWorld(world));
      const changed = (values) => this.say({ field: values });
      const holder = this.find(".field");
      this.field = world.uniform ? new parts.FieldPad(holder, this.camera, { most: this.most, changed }) : new parts.Sliders(holder, world.inputs, changed);
      this.speed = world.speed;
      const speed = this.find(".speed");
      Object.assign(speed, { min: Math.log(0.05 * world.speed), max: Math.log(world.fastest), step: "any", value: Math.log(world.speed) });
      speed.addEventListener("input", () => this.setSpeed(Math.exp(Number(speed.value))));
      this.setSpeed(world.speed);
      this.writeLimit(world.limit);
      for (const button of this.root.querySelectorAll("[data-help]")) {
        button.disabled = Boolean(world.noHelp) && button.dataset.help !== "none";
        if (button.disabled) button.title = world.noHelp;
      }
      this.outlets();
      this.scene.afterwards = () => this.placeOutlets();
      this.showWay();
      this.preset("overview");
    }

    scaled(limit) {
      const disc = Math.PI * (SPREAD * this.scene.lumenRadius) ** 2;
      this.scene.setScales({ force: 0.5 * limit, field: this.most, pressure: (1.5 * limit) / disc });
    }

    controls() {
      for (const button of this.root.querySelectorAll("[data-hold]")) this.hands.button(button);
      for (const button of this.root.querySelectorAll("[data-help]")) button.addEventListener("click", () => this.say({ help: button.dataset.help }));
      for (const button of this.root.querySelectorAll("[data-rewind]")) button.addEventListener("click", () => this.say({ rewind: Number(button.dataset.rewind) }));
      for (const button of this.root.querySelectorAll("[data-preset]")) button.addEventListener("click", () => this.preset(button.dataset.preset));
      this.find(".limit").addEventListener("change", () => this.setLimit());
      this.find(".limit").addEventListener("keydown", ({ key, target }) => key === "Enter" && target.blur()); // keys drive again
      this.find(".way").addEventListener("click", () => {
        this.scene.repaint(0);
        this.turns = false;
        this.showWay();
      });
      this.find(".take").addEventListener("click", () => this.say({ take: true }));
      this.find(".end").addEventListener("click", () => this.say({ end: true }));
      addEventListener("resize", () => this.untouched && this.preset(this.untouched));
      this.find(".scene").addEventListener("pointerdown", () => (this.untouched = ""));
    }

    preset(name) {
      this.untouched = name;
      parts.preset([this.scene], name);
      for (const button of this.root.querySelectorAll("[data-preset]")) button.classList.toggle("on", button.dataset.preset === name);
    }

    writeLimit(newtons) {
      this.find(".limit").value = Number((1e3 * newtons).toPrecision(3));
    }

    // The limit that was typed; what is none is taken back.
    setLimit() {
      const newtons = Number(this.find(".limit").value) / 1e3;
      if (newtons > 0 && newtons <= HARDEST) return this.say({ limit: newtons });
      const stays = this.picture?.limit ?? this.world.limit;
      this.writeLimit(stays);
      this.notice(`The limit must be above 0 and at most ${1e3 * HARDEST} mN; it stays at ${parts.newtons(stays)}.`);
      this.status();
    }

    setSpeed(speed) {
      this.speed = speed;
      this.find(".speed-words").textContent = `${(1e3 * speed).toPrecision(2)} mm/s`;
      this.hold();
    }

    // Keys that are pressed once; whether one of them it is.
    press(key) {
      const help = this.picture?.help;
      if (key === "f") this.say({ help: help === "assist" ? "none" : "assist" });
      else if (key === "g") this.say({ help: help === "suggest" ? "none" : "suggest" });
      else if (key === "z" || key === "Backspace") this.say({ rewind: REWIND });
      else if (["1", "2", "3", "4", "5"].includes(key)) this.preset(["overview", "x", "y", "z", "tip"][Number(key) - 1]);
      else return false;
      return true;
    }

    say(message) {
      return this.live?.say(message);
    }

    // Say what is held, at once if it has changed.
    hold(event) {
      if (!this.world) return;
      const { feed, twist } = this.hands.shares();
      const changed = feed !== this.last.feed || twist !== this.last.twist;
      const held = feed !== 0 || twist !== 0;
      const now = performance.now();
      if (!changed && !event && !(held && now - this.said >= SAY_EVERY)) return;
      if (!changed && !held) return;
      this.last = { feed, twist };
      this.said = now;
      this.begun ||= held;
      const number = this.say({ hold: [feed * this.speed, twist * this.world.turnRate] });
      if (event && changed) this.pending = { number, stamp: event.timeStamp };
    }

    turn(now) {
      const span = now - this.before;
      const dt = Math.min(0.1, span / 1e3);
      this.before = now;
      if (this.painted) this.pace.took(span);
      this.painted = false;
      if (!this.world) return;
      const { sideways, upwards, stronger } = this.hands.shares();
      if (this.world.uniform && (sideways || upwards || stronger) && this.picture?.help !== "assist") {
        const strength = this.field.strength + stronger * RISE * this.most * dt;
        this.field.strength = Math.max(0, Math.min(this.most, strength));
        this.field.turn(sideways * TURN * dt, upwards * TURN * dt);
        this.mine = now;
      }
      if (this.fresh) {
        this.show();
        this.painted = true;
      }
    }

    show() {
      this.fresh = false;
      const { picture, world } = this;
      const points = parts.singles(picture.points);
      const forces = parts.singles(picture.forces);
      if (picture.limit !== this.limit) {
        this.scaled((this.limit = picture.limit));
        this.writeLimit(this.limit);
      }
      const suggested = world.uniform ? picture.suggested : null;
      this.scene.show({ points, forces, field: picture.field, time: picture.time, suggested });
      this.arms.forEach((arm, k) => (!this.turns || picture.rate === 0 || (this.pictures + k) % 2) && arm.show({ points }));
      this.gauge.show({ force: picture.wallForce, peak: picture.peak, limit: picture.limit, tip: picture.tipForce });
      if (picture.help === "assist" || !world.uniform || !this.synchronised) this.field.show(picture.inputs, picture.wanted, picture.heard);
      this.synchronised = true;
      this.field.suggest(suggested);
      const words = { clock: `${picture.time.toFixed(1)} s`, inserted: `${(1e3 * picture.feed).toFixed(1)} mm`, push: parts.newtons(picture.push), strength: `${(1e3 * norm(picture.field)).toFixed(1)} mT`, clearance: picture.clearance === null ? "–" : `${(1e3 * picture.clearance).toFixed(2)} mm` };
      for (const [name, text] of Object.entries(words)) this.find(`.now-${name}`).textContent = text;
      for (const button of this.root.querySelectorAll("[data-help]")) button.classList.toggle("on", button.dataset.help === picture.help);
      if (picture.target !== this.target) this.aim(picture.target);
      this.status();
      if (this.pending && picture.heard >= this.pending.number) {
        this.latencies.push(performance.now() - this.pending.stamp);
        this.pending = null;
      }
      this.pictures += 1;
    }

    // Pictures take too long: shade less, or else paint the C-arms' in turns.
    hurry() {
      this.turns = !this.scene.hurry();
      this.showWay();
    }

    // How the 3D picture is painted, if not in the best way.
    showWay() {
      const { way } = this.scene;
      this.find(".way").textContent = WAYS[way];
      this.find(".way").hidden = way === 0;
    }

    aim(target) {
      this.target = target;
      this.arms.forEach((arm) => arm.aim(target));
      for (const button of this.root.querySelectorAll(".outlet")) button.classList.toggle("on", button.textContent === target);
    }

    // A button at the end of each branch.
    outlets() {
      const ways = Object.entries(this.world.ways);
      this.find(".helps p").hidden = this.world.target === null;
      if (this.world.target === null) return;
      for (const [name, way] of ways) {
        const button = Object.assign(document.createElement("button"), { className: "outlet", textContent: name, title: "Make this the target" });
        button.addEventListener("click", () => this.say({ target: name }));
        button.place = way.at(-1);
        this.find(".scene").append(button);
      }
    }

    placeOutlets() {
      const [width, height] = [this.find(".scene").clientWidth, this.find(".scene").clientHeight];
      const camera = Object.assign(new parts.Camera(), this.camera);
      camera.target = sub(camera.target, this.scene.shift.map((value) => -value));
      const project = camera.projector(width, height);
      for (const button of this.root.querySelectorAll(".outlet")) {
        const [x, y] = project(...button.place);
        const inside = x > 0 && y > 0 && x < width && y < height;
        button.hidden = !inside;
        [button.style.left, button.style.top] = [`${Math.min(x, width - button.offsetWidth - 6)}px`, `${y}px`];
      }
    }

    // One line on what is going on, the most pressing first.
    status() {
      const { picture, role } = this;
      let [text, level] = ["", "calm"];
      if (this.done) [text, level] = ["The drive has ended.", "calm"];
      else if (!this.connected) [text, level] = ["The connection to the server is lost; the wire has stopped. Trying again …", "bad"];
      else if (role && !role.drives) [text, level] = [role.free ? "Nobody drives." : "Another page drives; this one looks on.", "watch"];
      else if (picture?.message) [text, level] = [picture.message, "bad"];
      else if (this.said_ && performance.now() - this.saidAt < 4000) [text, level] = [this.said_, "bad"];
      else if (picture && picture.rate > 0 && picture.rate < SLOW) [text, level] = [`The clock is slowed to ${picture.rate.toFixed(2)}: this machine cannot keep up. No step is left out.`, "watch"];
      else if (picture && role?.drives && !this.begun && picture.feed === 0) text = this.world.noHelp ? "Hold ↑ to feed the wire." : "Hold ↑ to feed the wire; F has the navigator steer.";
      const line = this.find(".status");
      if (line.textContent !== text) line.textContent = text;
      line.dataset.level = level;
      this.find(".take").hidden = !role || role.drives || this.done;
      const rate = this.find(".now-rate");
      rate.textContent = !picture || picture.rate === 0 ? "at rest" : `${picture.rate.toFixed(2)}×`;
      rate.classList.toggle("slow", Boolean(picture) && picture.rate > 0 && picture.rate < SLOW);
    }

    notice(text) {
      this.said_ = text;
      this.saidAt = performance.now();
      setTimeout(() => this.status(), 4100);
    }

    report({ rows, failure }) {
      this.done = true;
      const box = this.find(".report");
      const table = box.querySelector("dl");
      table.replaceChildren();
      for (const [name, value] of Object.entries(rows)) {
        table.append(Object.assign(document.createElement("dt"), { textContent: name }), Object.assign(document.createElement("dd"), { textContent: value }));
      }
      box.querySelector("p").textContent = failure;
      box.hidden = false;
    }
  }

  parts.begin = () => {
    const cockpit = new Cockpit(document.querySelector(".page"));
    // What tests and the curious may ask, in SI units.
    window.magwire = {
      cockpit,
      get mode() { return cockpit.scene?.mode; },
      get picture() { return cockpit.picture; },
      get role() { return cockpit.role; },
      get latencies() { return cockpit.latencies; },
      get pictures() { return cockpit.pictures; },
      get gauge() { return { force: cockpit.gauge.force, level: cockpit.gauge.level, written: cockpit.gauge.output.textContent }; },
      points: () => [...cockpit.scene.state.points],
      forces: () => [...cockpit.scene.state.forces],
      say: (message) => cockpit.say(message),
    };
  };
})((window.magwireParts ??= {}));
