// The connection to the server: says what is done here, hears what has become of the wire.
"use strict";
((parts) => {
  const AGAIN = [300, 600, 1200, 2500]; // waits before it is tried again [ms]

  // Singles of a text as magwire.drive.world packs them.
  function singles(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Float32Array(bytes.buffer);
  }

  class Live {
    // hear: called with each message, and with {connected: true or false}.
    constructor(hear) {
      this.hear = hear;
      this.number = 0;
      this.tried = 0;
      this.ended = false;
      this.connect();
    }

    connect() {
      const socket = new WebSocket(`ws://${location.host}/live${location.search}`);
      this.socket = socket;
      socket.addEventListener("open", () => {
        this.tried = 0;
        this.hear({ connected: true });
      });
      socket.addEventListener("message", ({ data }) => {
        const message = JSON.parse(data);
        if (message.report) this.ended = true;
        this.hear(message);
      });
      socket.addEventListener("close", () => {
        this.hear({ connected: false });
        if (this.ended) return;
        setTimeout(() => this.connect(), AGAIN[Math.min(this.tried++, AGAIN.length - 1)]);
      });
    }

    // Say something; returns the number that the server answers with when it has heard it.
    say(message) {
      this.number += 1;
      if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ ...message, number: this.number }));
      return this.number;
    }
  }

  parts.Live = Live;
  parts.singles = singles;
})((window.magwireParts ??= {}));
