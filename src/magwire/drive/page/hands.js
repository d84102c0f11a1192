// What is held down: keys, buttons of the page, and a gamepad, as shares of the speeds.
"use strict";
((parts) => {
  const KEYS = {
    ArrowUp: "advance", w: "advance",
    ArrowDown: "retract", s: "retract",
    ArrowLeft: "left", a: "left",
    ArrowRight: "right", d: "right",
    i: "fieldUp", k: "fieldDown", j: "fieldLeft", l: "fieldRight",
    o: "stronger", u: "weaker",
  };
  const DEAD_ZONE = 0.15;
  const past = (value) => (Math.abs(value) < DEAD_ZONE ? 0 : (value - Math.sign(value) * DEAD_ZONE) / (1 - DEAD_ZONE));
  const typing = ({ target }) => target.matches?.("input:not([type=range]), select, textarea");

  class Hands {
    // changed: called at once when something is pressed or let go, with the event; pressed: by keys that are not held.
    constructor({ changed, pressed }) {
      this.held = new Map(); // what is held, and by what
      this.changed = changed;
      this.pads = 0;
      addEventListener("keydown", (event) => {
        if (typing(event) || event.ctrlKey || event.metaKey || event.altKey) return;
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        if (KEYS[key]) {
          event.preventDefault();
          if (!event.repeat) this.press(`key ${event.code}`, KEYS[key], event);
        } else if (!event.repeat && pressed(key)) event.preventDefault();
      });
      addEventListener("keyup", (event) => this.release(`key ${event.code}`, event));
      const drop = (event) => this.held.size && (this.held.clear(), this.changed(event));
      addEventListener("blur", drop);
      document.addEventListener("visibilitychange", (event) => document.hidden && drop(event));
      this.wasPressed = [];
      this.pressed = pressed;
    }

    // A button of the page that is held.
    button(element) {
      const what = element.dataset.hold;
      element.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        element.setPointerCapture(event.pointerId);
        this.press(`pointer ${event.pointerId}`, what, event);
      });
      for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) element.addEventListener(kind, (event) => this.release(`pointer ${event.pointerId}`, event));
      element.addEventListener("contextmenu", (event) => event.preventDefault());
    }

    press(by, what, event) {
      this.held.set(by, what);
      this.changed(event);
    }

    release(by, event) {
      if (this.held.delete(by)) this.changed(event);
    }

    has(what) {
      for (const held of this.held.values()) if (held === what) return 1;
      return 0;
    }

    // Shares between -1 and 1: left stick feeds and twists, right stick turns the field, triggers set its strength.
    shares() {
      const pad = [...(navigator.getGamepads?.() ?? [])].find((one) => one?.connected);
      const axis = (k) => past(pad?.axes[k] ?? 0);
      const down = (k) => pad?.buttons[k]?.value ?? 0;
      if (pad) ["f", "g", "z"].forEach((key, k) => {
        if (down(k) > 0.5 && !this.wasPressed[k]) this.pressed(key);
        this.wasPressed[k] = down(k) > 0.5;
      });
      const bound = (value) => Math.max(-1, Math.min(1, value));
      return {
        feed: bound(this.has("advance") - this.has("retract") - axis(1)),
        twist: bound(this.has("right") - this.has("left") + axis(0)),
        sideways: bound(this.has("fieldRight") - this.has("fieldLeft") + axis(2)),
        upwards: bound(this.has("fieldUp") - this.has("fieldDown") - axis(3)),
        stronger: bound(this.has("stronger") - this.has("weaker") + down(7) - down(6)),
      };
    }
  }

  parts.Hands = Hands;
})((window.magwireParts ??= {}));
