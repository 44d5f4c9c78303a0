// SPDX-License-Identifier: Apache-2.0
// Drawing without a graphics card: the browser runs shaders on the processor, so simpler texture filtering is used, and
// edges are smoothed in a filter after drawing.
import { FramebufferTexture, LinearFilter, LinearMipmapNearestFilter, NoBlending, ShaderMaterial, Vector2 } from 'three';
import { FullScreenQuad } from 'three/examples/jsm/postprocessing/Pass.js';

let answer = null;

/// Whether the browser draws without a graphics card.
export function drawsInSoftware() {
  if (answer !== null) return answer;
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  answer = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  return answer;
}

/// Sets the filter of a texture: anisotropic on a graphics card, without interpolation between mipmap levels otherwise.
export function filtered(texture) {
  if (drawsInSoftware()) texture.minFilter = LinearMipmapNearestFilter;
  else texture.anisotropy = 4;
  return texture;
}

/// Smooths edges in the drawn image, in place of multisampling: blends neighbouring pixels along edges (Lottes 2009,
/// "FXAA").
export class SmoothEdges {
  constructor() {
    this.material = new ShaderMaterial({
      depthTest: false, depthWrite: false, blending: NoBlending,
      uniforms: { drawn: { value: null }, texel: { value: new Vector2() } },
      vertexShader: 'varying vec2 vPlace; void main() { vPlace = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
      fragmentShader: `
        varying vec2 vPlace;
        uniform sampler2D drawn;
        uniform vec2 texel;
        const vec4 seen = vec4(0.299, 0.587, 0.114, 1.0);
        vec4 at(float x, float y) { return texture2D(drawn, vPlace + texel * vec2(x, y)); }
        vec4 pixel(int x, int y) { return texelFetch(drawn, ivec2(gl_FragCoord.xy) + ivec2(x, y), 0); } // unfiltered, at half the cost
        void main() {
          vec4 here = pixel(0, 0);
          float nw = dot(pixel(-1, 1), seen), ne = dot(pixel(1, 1), seen);
          float sw = dot(pixel(-1, -1), seen), se = dot(pixel(1, -1), seen), middle = dot(here, seen);
          float low = min(middle, min(min(nw, ne), min(sw, se))), high = max(middle, max(max(nw, ne), max(sw, se)));
          gl_FragColor = here;
          if (high - low < max(0.06, 0.1 * high)) return; // no contrast
          vec2 way = vec2(sw + se - nw - ne, nw + sw - ne - se);
          float flat_ = max(0.03125 * (nw + ne + sw + se), 0.0078125);
          way = clamp(way / (min(abs(way.x), abs(way.y)) + flat_), -8.0, 8.0);
          vec4 inner = 0.5 * (at(way.x * -0.1667, way.y * -0.1667) + at(way.x * 0.1667, way.y * 0.1667));
          vec4 outer = 0.5 * inner + 0.25 * (at(-0.5 * way.x, -0.5 * way.y) + at(0.5 * way.x, 0.5 * way.y));
          float found = dot(outer, seen);
          gl_FragColor = found < low || found > high ? inner : outer;
        }`,
    });
    this.quad = new FullScreenQuad(this.material);
    this.size = new Vector2();
  }

  /// Smooths the image on the canvas.
  apply(renderer) {
    const { size, material: { uniforms } } = this;
    renderer.getDrawingBufferSize(size);
    const { value } = uniforms.drawn;
    if (!value || value.image.width !== size.x || value.image.height !== size.y) {
      value?.dispose();
      uniforms.drawn.value = new FramebufferTexture(size.x, size.y);
      uniforms.drawn.value.minFilter = LinearFilter;
      uniforms.drawn.value.magFilter = LinearFilter;
      uniforms.texel.value.set(1 / size.x, 1 / size.y);
    }
    renderer.copyFramebufferToTexture(uniforms.drawn.value);
    const { autoClear } = renderer;
    renderer.autoClear = false;
    this.quad.render(renderer);
    renderer.autoClear = autoClear;
  }
}
