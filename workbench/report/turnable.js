// The specimen, to be turned: spheres as shaded points, bonds as lines, drawn by three.js. What is drawn is told by the page itself.
"use strict";
(function () {
  const box = document.getElementById("turnable");
  if (!box) return;
  const say = (text) => { box.querySelector(".info").textContent = text; };
  const data = JSON.parse(document.getElementById("turnable-data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const floats = (text) => new Float32Array(bytes(text));
  const count = data.elements;
  const rest = floats(data.rest), radius = floats(data.radius), ids = new Int32Array(bytes(data.id)), sets = new Uint8Array(bytes(data.color));
  const frames = data.frames.map((f) => ({
    label: f.label, position: floats(f.position), fields: f.fields.map(floats),
    ends: new Uint32Array(bytes(f.ends)), state: new Uint8Array(bytes(f.state)),
  }));
  const stateColor = [[0.357, 0.592, 0.82], [0.961, 0.639, 0], [0.702, 0.071, 0.247]];

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  } catch (error) {
    box.classList.add("none");
    return say("This browser draws nothing in three dimensions (no WebGL); the pictures below are all there is.");
  }
  const canvas = renderer.domElement;
  box.querySelector(".stage").appendChild(canvas);
  const scene = new THREE.Scene(), body = new THREE.Group();
  scene.add(body);
  const size = Math.max(data.size[0], data.size[1], data.size[2]);
  const far = 6 * size;
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 2 * far);
  camera.position.z = far;
  const deep = !!renderer.extensions.get("EXT_frag_depth");

  const uniforms = { pixels: { value: 1 }, plane: { value: new THREE.Vector4(0, 0, 0, 1) }, depth: { value: 1 / (2 * far) }, faint: { value: 1 } };
  const spheres = new THREE.BufferGeometry();
  spheres.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  spheres.setAttribute("tint", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  spheres.setAttribute("size", new THREE.BufferAttribute(radius, 1));
  const points = new THREE.Points(spheres, new THREE.ShaderMaterial({
    uniforms, extensions: { fragDepth: deep }, defines: deep ? { DEEP: 1 } : {},
    vertexShader: `attribute float size; attribute vec3 tint; uniform float pixels; uniform vec4 plane; varying vec3 color; varying float bulge;
      void main() {
        color = tint; bulge = size;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_PointSize = max(1.5, 2.0 * size * pixels);
        if (dot(plane.xyz, position) > plane.w) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      }`,
    fragmentShader: `uniform float depth; uniform float faint; varying vec3 color; varying float bulge;
      void main() {
        vec2 p = 2.0 * gl_PointCoord - 1.0;
        float r = dot(p, p);
        if (r > 1.0) discard;
        float z = sqrt(1.0 - r);
        #ifdef DEEP
        gl_FragDepthEXT = gl_FragCoord.z - z * bulge * depth;
        #endif
        float light = 0.35 + 0.65 * max(0.0, dot(vec3(p.x, -p.y, z), vec3(-0.35, 0.45, 0.82)));
        gl_FragColor = vec4(mix(vec3(0.85), color, faint) * light, 1.0);
      }`,
  }));
  points.frustumCulled = false;
  body.add(points);
  const lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors }));
  lines.frustumCulled = false;
  body.add(lines);
  const frameOfBox = new THREE.LineSegments(
    new THREE.EdgesGeometry(new THREE.BoxBufferGeometry(data.size[0], data.size[1], data.size[2])),
    new THREE.LineBasicMaterial({ color: 0x888888 }));
  body.add(frameOfBox);

  const control = (name) => box.querySelector(`[name=${name}]`);
  const slider = control("frame"), color = control("color"), cut = control("cut"), at = control("at"), what = control("what");
  slider.max = frames.length - 1;
  slider.value = frames.length - 1;
  data.fields.forEach((field, k) => color.add(new Option(field.unit ? `${field.name} [${field.unit}]` : field.name, k)));

  // As the still pictures have it: from dark blue over green to yellow.
  const stops = [[0.27, 0, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];
  function shade(share) {
    const s = Math.min(0.9999, Math.max(0, share)) * (stops.length - 1), k = Math.floor(s), t = s - k;
    return stops[k].map((low, c) => low + t * (stops[k + 1][c] - low));
  }
  function rangeOf(k) {  // over all frames, without the hundredth at either end
    const all = [];
    for (const frame of frames) for (let i = 0; i < count; i += Math.ceil(count / 4000)) if (isFinite(frame.fields[k][i])) all.push(frame.fields[k][i]);
    all.sort((a, b) => a - b);
    return all.length ? [all[Math.floor(0.01 * (all.length - 1))], all[Math.ceil(0.99 * (all.length - 1))]] : [0, 0];
  }
  const ranges = data.fields.map((_, k) => rangeOf(k));
  const short = (value) => Number(value.toPrecision(4)).toString();

  function worstOf(frame) {  // of the bonds of each element
    const worst = new Uint8Array(count);
    for (let b = 0; b < frame.state.length; ++b)
      for (let e = 0; e < 2; ++e) worst[frame.ends[2 * b + e]] = Math.max(worst[frame.ends[2 * b + e]], frame.state[b]);
    return worst;
  }
  function paint(frame) {
    const tint = spheres.attributes.tint.array, bar = box.querySelector(".bar");
    const field = color.value === "set" || color.value === "state" ? -1 : Number(color.value);
    const worst = color.value === "state" ? worstOf(frame) : null;
    for (let i = 0; i < count; ++i) {
      let rgb = [sets[3 * i] / 255, sets[3 * i + 1] / 255, sets[3 * i + 2] / 255];
      if (worst && worst[i]) rgb = stateColor[worst[i]];
      if (field >= 0) {
        const [low, high] = ranges[field], value = frame.fields[field][i];
        rgb = isFinite(value) ? shade(high > low ? (value - low) / (high - low) : 0.5) : [0.6, 0.6, 0.6];
      }
      tint.set(rgb, 3 * i);
    }
    spheres.attributes.tint.needsUpdate = true;
    bar.style.visibility = field >= 0 ? "visible" : "hidden";
    if (field >= 0) {
      bar.querySelector(".low").textContent = short(ranges[field][0]);
      bar.querySelector(".high").textContent = short(ranges[field][1]);
    }
  }
  const mode = () => ({ bodies: what.value !== "cracks", bonds: what.value !== "bodies" });
  // Bonds are shown where they were: what flies about says nothing of a crack.
  const places = () => (what.value === "bodies" ? current().position : rest);
  function join(frame) {
    const place = [], tint = [];
    const show = mode().bonds;
    for (let b = 0; show && b < frame.state.length; ++b) {
      if (what.value === "cracks" && frame.state[b] === 0) continue;
      for (let e = 0; e < 2; ++e) {
        const i = 3 * frame.ends[2 * b + e];
        place.push(rest[i], rest[i + 1], rest[i + 2]);
        tint.push(...stateColor[frame.state[b]]);
      }
    }
    const drawn = new THREE.BufferGeometry();
    const kept = [];
    const plane = uniforms.plane.value;
    for (let k = 0; k < place.length; k += 6) {
      const outside = (o) => plane.x * place[k + o] + plane.y * place[k + o + 1] + plane.z * place[k + o + 2] > plane.w;
      if (!outside(0) && !outside(3)) kept.push(k);
    }
    drawn.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(kept.flatMap((k) => place.slice(k, k + 6))), 3));
    drawn.setAttribute("color", new THREE.BufferAttribute(Float32Array.from(kept.flatMap((k) => tint.slice(k, k + 6))), 3));
    lines.geometry.dispose();
    lines.geometry = drawn;
    lines.visible = kept.length > 0;
    return kept.length;
  }

  let bondsDrawn = 0;
  const current = () => frames[Number(slider.value)];
  function update() {
    const frame = current(), axis = "xyz".indexOf(cut.value);
    uniforms.plane.value.set(axis === 0, axis === 1, axis === 2, axis < 0 ? 1 : (Number(at.value) / 1000 - 0.5) * data.size[axis] * 1.02);
    at.disabled = axis < 0;
    spheres.attributes.position.array.set(places());
    spheres.attributes.position.needsUpdate = true;
    paint(frame);
    bondsDrawn = join(frame);
    points.visible = mode().bodies;
    uniforms.faint.value = what.value === "both" ? 0.25 : 1;
    lines.material.depthTest = what.value !== "both";  // seen through the elements
    lines.renderOrder = 1;
    box.querySelector(".when").textContent = frame.label + (what.value === "bodies" ? "" : ", not deformed");
    draw();
  }

  let zoom = 1, panX = 0, panY = 0, waiting = false;
  function render() {
    waiting = false;
    const width = canvas.clientWidth || 800, height = canvas.clientHeight || 460, ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
    }
    const half = 0.68 * size / zoom, wide = half * width / height;
    Object.assign(camera, { left: panX - wide, right: panX + wide, top: panY + half, bottom: panY - half });
    camera.updateProjectionMatrix();
    uniforms.pixels.value = ratio * height / (2 * half);
    renderer.render(scene, camera);
  }
  function draw() {
    if (!waiting) requestAnimationFrame(render);
    waiting = true;
  }
  function turn(dx, dy) {
    const step = new THREE.Quaternion().setFromEuler(new THREE.Euler(dy * 0.008, dx * 0.008, 0));
    body.quaternion.premultiply(step);
    draw();
  }
  const views = { x: [0, -Math.PI / 2], y: [Math.PI / 2, 0], z: [0, 0] };
  function lookAlong(axis) {
    const [a, b] = views[axis];
    body.quaternion.setFromEuler(new THREE.Euler(a, b, 0));
    zoom = 1; panX = panY = 0;
    draw();
  }

  // The foremost sphere under a point of the canvas.
  function pick(x, y) {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    const wx = camera.left + (x / width) * (camera.right - camera.left), wy = camera.top - (y / height) * (camera.top - camera.bottom);
    const p = new THREE.Vector3(), plane = uniforms.plane.value, position = places();
    let best = -1, front = -Infinity;
    for (let i = 0; i < count; ++i) {
      p.set(position[3 * i], position[3 * i + 1], position[3 * i + 2]);
      if (plane.x * p.x + plane.y * p.y + plane.z * p.z > plane.w) continue;
      p.applyQuaternion(body.quaternion);
      const d = (p.x - wx) ** 2 + (p.y - wy) ** 2, r = radius[i] ** 2;
      if (d < r && p.z + Math.sqrt(r - d) > front) front = p.z + Math.sqrt(r - d), best = i;
    }
    return best;
  }
  function describe(i) {
    if (i < 0) return "Drag to turn, wheel to zoom, shift and drag to move, click on an element for its numbers.";
    const frame = current();
    const place = [0, 1, 2].map((c) => ((frame.position[3 * i + c] + data.centre[c]) * data.factor).toPrecision(6)).join(", ");
    const values = data.fields.map((field, k) => `${field.name} ${Number(frame.fields[k][i].toPrecision(6))}${field.unit ? " " + field.unit : ""}`);
    return [`element ${ids[i]} at (${place}) ${data.unit}, radius ${(radius[i] * data.factor).toPrecision(6)} ${data.unit}`, ...values].join("; ");
  }

  let held = null, moved = false;
  canvas.addEventListener("pointerdown", (e) => { held = e; moved = false; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointermove", (e) => {
    if (!held) return;
    const dx = e.clientX - held.clientX, dy = e.clientY - held.clientY;
    if (Math.abs(dx) + Math.abs(dy) < 2) return;
    moved = true;
    if (e.shiftKey || held.button === 2) {
      const unit = (camera.right - camera.left) / canvas.clientWidth;
      panX -= dx * unit; panY += dy * unit;
      draw();
    } else turn(dx, dy);
    held = { clientX: e.clientX, clientY: e.clientY, button: held.button };
  });
  canvas.addEventListener("pointerup", (e) => {
    if (held && !moved) say(describe(pick(e.offsetX, e.offsetY)));
    held = null;
  });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom = Math.min(60, Math.max(0.3, zoom * Math.exp(-e.deltaY * 0.0015))); draw(); }, { passive: false });
  for (const each of [slider, color, cut, at, what]) each.addEventListener("input", update);
  box.querySelectorAll("[data-along]").forEach((button) => button.addEventListener("click", () => lookAlong(button.dataset.along)));
  window.addEventListener("resize", draw);
  lookAlong(data.view);
  update();
  say(describe(-1));
  window.beadworkView = {  // for tests
    pick, describe, turn,
    state: () => ({ frame: Number(slider.value), bonds: bondsDrawn, quaternion: body.quaternion.toArray(), elements: count }),
  };
})();
