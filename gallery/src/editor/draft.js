// SPDX-License-Identifier: Apache-2.0
// Skin that moves where no graphics card draws. Shaders run on the processor there, and for a vertex
// again and again as triangles come by; so colour and light are computed once a vertex in typed
// arrays, and the shader does no more than to place it.
import { BufferAttribute, FrontSide, ShaderMaterial } from 'three';
import { keyShare, lightIn, shoulder, withBounces } from '../studio.js';

function toneOf(light) {
  const y = Math.min(shoulder(light), 1);
  return y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055;
}

const steps = 4096;
const brightest = 2;
const typicalAlbedo = 0.3; // of light that bounces
const tones = Uint8Array.from({ length: steps + 1 }, (_, i) => Math.round(255 * toneOf((i * brightest) / steps)));

export class Draft {
  /// \param geometry  with regionColour; \param colours  linear light, three a vertex;
  /// \param palette   colours of distances, near to far.
  /// \param textured  which vertices have a place in the map
  constructor(geometry, blender, colours, textured, palette) {
    Object.assign(this, { geometry, blender, colours, textured, palette });
    this.setSky(new Float32Array(colours.length / 3).fill(1));
    this.count = colours.length / 3;
    this.points = new BufferAttribute(blender.points, 4);
    this.shades = new BufferAttribute(new Uint8Array(4 * this.count), 4, true);
    geometry.setAttribute('facePoint', this.points);
    geometry.setAttribute('shade', this.shades);
    this.material = new ShaderMaterial({
      side: FrontSide,
      uniforms: { map: { value: null } },
      vertexShader: `
        attribute vec4 facePoint, shade;
        varying vec4 vShade;
        #ifdef TEXTURED
          varying vec2 vPlace;
        #endif
        void main() {
          vShade = shade;
          #ifdef TEXTURED
            vPlace = uv;
          #endif
          gl_Position = projectionMatrix * modelViewMatrix * vec4(facePoint.xyz, 1.0);
        }`,
      fragmentShader: `
        varying vec4 vShade;
        #ifdef TEXTURED
          uniform sampler2D map;
          varying vec2 vPlace;
        #endif
        void main() {
          #ifdef TEXTURED
            vec3 light = 2.0 * vShade.rgb * mix(vec3(1.0), texture2D(map, vPlace).rgb, vShade.a);
            vec3 over = max(light - 0.6, 0.0) / 0.4;
            gl_FragColor = vec4(min(light, 0.6) + 0.4 * over / (1.0 + 0.55 * over), 1.0);
            #include <colorspace_fragment>
          #else
            gl_FragColor = vec4(vShade.rgb, 1.0);
          #endif
        }`,
    });
  }

  /// \param sky  share of the sky that each vertex sees
  setSky(sky) {
    this.sky = sky;
    this.lit = sky.map(keyShare);
    this.open = sky.map((share) => withBounces(share, typicalAlbedo));
  }

  setMap(map) {
    const { material } = this;
    material.uniforms.map.value = map;
    material.defines = map ? { TEXTURED: 1 } : {};
    material.needsUpdate = true;
  }

  /// Points have changed: they go to where they are drawn.
  moved() {
    this.points.needsUpdate = true;
  }

  /// \param show  as HeadView.setShow; \param farthest  distance of the palette's end.
  shade(camera, group, show, farthest) {
    const light = lightIn(camera, group, 'skin');
    const { points, normals } = this.blender;
    const shades = this.shades.array;
    const regions = this.geometry.getAttribute('regionColour').array;
    const surface = [0, 0, 0];
    const hasMap = this.material.uniforms.map.value !== null;
    const sum = [0, 0, 0];
    for (let v = 0; v < this.count; v += 1) {
      light(normals[4 * v], normals[4 * v + 1], normals[4 * v + 2], this.sky[v], this.lit[v], this.open[v], sum);
      const isTextured = hasMap && this.textured[v];
      if (isTextured) surface.fill(1);
      else this.surfaceAt(v, show, points[4 * v + 3] / farthest, regions, surface);
      if (hasMap) {
        shades[4 * v + 3] = isTextured ? 255 : 0;
        for (let c = 0; c < 3; c += 1) shades[4 * v + c] = Math.min(127.5 * sum[c] * surface[c], 255);
        continue;
      }
      for (let c = 0; c < 3; c += 1) {
        shades[4 * v + c] = tones[Math.min(steps, Math.round((sum[c] * surface[c] * steps) / brightest))];
      }
    }
    this.shades.needsUpdate = true;
  }

  surfaceAt(v, show, distance, regions, surface) {
    const { colours, palette } = this;
    if (show === 'distance') {
      const place = Math.min(distance, 1) * (palette.length - 1);
      const low = Math.min(Math.floor(place), palette.length - 2);
      const [a, b] = [palette[low], palette[low + 1]];
      surface[0] = a.r + (place - low) * (b.r - a.r);
      surface[1] = a.g + (place - low) * (b.g - a.g);
      surface[2] = a.b + (place - low) * (b.b - a.b);
      return;
    }
    const part = show === 'regions' ? 0.72 : 0;
    for (let c = 0; c < 3; c += 1) {
      const own = colours[3 * v + c];
      surface[c] = own + part * (regions[3 * v + c] - own);
    }
  }
}
