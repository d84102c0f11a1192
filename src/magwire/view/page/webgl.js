// Paints a picture with WebGL 2: far wall, wire and arrows, near wall.
"use strict";
((parts) => {
  const SOLID_VERTEX = `#version 300 es
    uniform mat4 matrix;
    in vec3 position, normal;
    in vec4 colour;
    out vec3 n, p;
    out vec4 c;
    void main() { n = normal; p = position; c = colour; gl_Position = matrix * vec4(position, 1.0); }`;
  const SOLID_FRAGMENT = `#version 300 es
    precision highp float;
    uniform vec3 eye, light;
    in vec3 n, p;
    in vec4 c;
    out vec4 shown;
    void main() {
      vec3 normal = normalize(n), towards = normalize(eye - p);
      float lit = 0.5 + 0.5 * dot(normal, light);
      float shine = pow(max(dot(normal, normalize(light + towards)), 0.0), 40.0);
      vec3 colour = c.rgb * (0.5 + 0.65 * lit) + 0.35 * shine;
      shown = vec4(colour * c.a, c.a);
    }`;
  const WALL_VERTEX = `#version 300 es
    uniform mat4 matrix;
    in vec3 position, normal;
    in float heat;
    out vec3 n, p;
    out float h;
    void main() { n = normal; p = position; h = heat; gl_Position = matrix * vec4(position, 1.0); }`;
  const WALL_FRAGMENT = `#version 300 es
    precision highp float;
    uniform vec3 eye, light, lumen;
    uniform float near;
    uniform sampler2D map;
    in vec3 n, p;
    in float h;
    out vec4 shown;
    void main() {
      vec3 normal = normalize(n), towards = normalize(eye - p);
      float facing = abs(dot(normal, towards));
      float edge = pow(1.0 - facing, 2.2);
      float alpha = mix(0.07, 0.62, edge) * mix(1.25, 1.0, near);
      float shine = pow(max(dot(normal * sign(dot(normal, towards)), normalize(light + towards)), 0.0), 60.0);
      vec3 colour = mix(lumen * 1.12, lumen * 0.78, edge);
      vec4 hot = texture(map, vec2(clamp(h, 0.002, 0.998), 0.5));
      float cover = hot.a * smoothstep(0.0, 0.04, h);
      colour = mix(colour, hot.rgb, cover);
      alpha = max(alpha, cover * mix(0.9, 0.62, near));
      shown = vec4(colour * alpha + 0.22 * near * shine, alpha + 0.22 * near * shine);
    }`;

  function program(gl, vertex, fragment, names) {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    names.forEach((name, place) => gl.bindAttribLocation(made, place, name));
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    return { made, place: (name) => gl.getUniformLocation(made, name) };
  }

  function bySoftware(gl) {
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  }

  class WebglPainter {
    // quick: whether it must be by a graphics processor. Throws where there is no such WebGL 2.
    constructor(canvas, { antialias = true, quick = false } = {}) {
      this.gl = canvas.getContext("webgl2", { antialias, premultipliedAlpha: true, preserveDrawingBuffer: true });
      if (!this.gl) throw new Error("no WebGL 2");
      if (quick && bySoftware(this.gl)) throw new Error("no graphics processor");
      this.canvas = canvas;
      this.mode = "webgl2";
      const gl = this.gl;
      this.solid = program(gl, SOLID_VERTEX, SOLID_FRAGMENT, ["position", "normal", "colour"]);
      this.walls = program(gl, WALL_VERTEX, WALL_FRAGMENT, ["position", "normal", "heat"]);
      this.buffers = {};
      this.map = this.colourMap();
      this.count = 0;
    }

    colourMap() {
      const gl = this.gl;
      const pixels = new Uint8Array(4 * 256);
      for (let k = 0; k < 256; k++) pixels.set(parts.colours.heat(k / 255).map((x) => Math.round(255 * x)), 4 * k);
      const texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
      return texture;
    }

    fill(name, values, kind = this.gl.ARRAY_BUFFER) {
      const gl = this.gl;
      this.buffers[name] ??= gl.createBuffer();
      gl.bindBuffer(kind, this.buffers[name]);
      gl.bufferData(kind, values, gl.DYNAMIC_DRAW);
    }

    attribute(place, name, size) {
      const gl = this.gl;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }

    setWall(mesh) {
      this.fill("wall", mesh.positions);
      this.fill("wallNormal", mesh.normals);
      this.fill("wallIndex", mesh.indices, this.gl.ELEMENT_ARRAY_BUFFER);
      this.count = mesh.indices.length;
    }

    // The same wall elsewhere.
    moveWall(mesh) {
      this.fill("wall", mesh.positions);
    }

    // What moves: the pressure over the largest one, tubes, arrows.
    setMoving({ heat, tubes, arrows }) {
      const solid = new parts.geometry.Solid();
      for (const { points, radii, colours } of tubes) solid.tube(points, radii, colours);
      for (const { from, by, radius, colour } of arrows) solid.arrow(from, by, radius, colour);
      this.fill("heat", heat);
      this.fill("solid", new Float32Array(solid.positions));
      this.fill("solidNormal", new Float32Array(solid.normals));
      this.fill("solidColour", new Float32Array(solid.colours));
      this.fill("solidIndex", new Uint32Array(solid.indices), this.gl.ELEMENT_ARRAY_BUFFER);
      this.solids = solid.indices.length;
    }

    paint(camera, reach) {
      const gl = this.gl;
      const { width, height } = this.canvas;
      gl.viewport(0, 0, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.depthMask(true);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      this.matrix = camera.matrix(width / height, reach);
      this.eye = camera.eye();
      const { right, up, back } = camera.axes();
      this.light = parts.algebra.unit([0, 1, 2].map((k) => 0.9 * back[k] + 0.65 * up[k] - 0.45 * right[k]));
      this.paintWall(gl.FRONT, 0);
      this.paintSolid();
      this.paintWall(gl.BACK, 1);
    }

    use({ made, place }) {
      this.gl.useProgram(made);
      this.gl.uniformMatrix4fv(place("matrix"), false, this.matrix);
      this.gl.uniform3fv(place("eye"), this.eye);
      this.gl.uniform3fv(place("light"), this.light);
    }

    paintWall(culled, near) {
      if (!this.count) return;
      const gl = this.gl;
      this.use(this.walls);
      gl.uniform1f(this.walls.place("near"), near);
      gl.uniform3fv(this.walls.place("lumen"), parts.colours.lumen);
      gl.bindTexture(gl.TEXTURE_2D, this.map);
      this.attribute(0, "wall", 3);
      this.attribute(1, "wallNormal", 3);
      this.attribute(2, "heat", 1);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.wallIndex);
      gl.enable(gl.CULL_FACE);
      gl.cullFace(culled);
      gl.depthMask(false);
      gl.drawElements(gl.TRIANGLES, this.count, gl.UNSIGNED_INT, 0);
      gl.depthMask(true);
      gl.disable(gl.CULL_FACE);
    }

    paintSolid() {
      if (!this.solids) return;
      const gl = this.gl;
      this.use(this.solid);
      this.attribute(0, "solid", 3);
      this.attribute(1, "solidNormal", 3);
      this.attribute(2, "solidColour", 4);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.solidIndex);
      gl.enable(gl.CULL_FACE);
      gl.cullFace(gl.BACK);
      gl.drawElements(gl.TRIANGLES, this.solids, gl.UNSIGNED_INT, 0);
      gl.disable(gl.CULL_FACE);
    }
  }

  parts.WebglPainter = WebglPainter;
})((window.magwireParts ??= {}));
