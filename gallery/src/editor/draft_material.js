// SPDX-License-Identifier: Apache-2.0
// A plain material for what moves where no graphics card draws: light at the vertices, no gloss.
import { Color, FrontSide, ShaderMaterial, Vector3 } from 'three';
import { eyeShader, eyeUniforms, lamps, sky } from '../stage.js';
import { fetchVertex } from './surface.js';

/// \param uniforms  facePoints, faceNormals, faceShow, farthest, distanceColours; \param eyes  or nothing.
export function draftMaterial(uniforms, eyes) {
  const target = new Vector3(0, 0, -6);
  return new ShaderMaterial({
    side: FrontSide,
    vertexColors: true,
    defines: { LAMPS: lamps.length, STEPS: uniforms.distanceColours.value.length, ...(eyes ? { EYES: 1 } : {}) },
    uniforms: {
      ...uniforms,
      ...(eyes ? eyeUniforms(eyes) : {}),
      map: { value: null },
      lampWays: { value: lamps.map(({ at }) => new Vector3(...at).sub(target).normalize()) },
      lampColours: { value: lamps.map(({ colour, strength }) => new Color(colour).multiplyScalar(strength)) },
      above: { value: new Color(sky.above).multiplyScalar(sky.strength) },
      below: { value: new Color(sky.below).multiplyScalar(sky.strength) },
      ambient: { value: sky.ambient },
    },
    vertexShader: `
      uniform highp sampler2D facePoints, faceNormals;
      uniform int faceShow;
      uniform float farthest, ambient;
      uniform vec3 distanceColours[STEPS], lampWays[LAMPS], lampColours[LAMPS], above, below;
      attribute vec3 regionColour;
      varying vec3 vLight, vColour;
      varying vec2 vUv;
      ${fetchVertex}
      ${eyes ? eyeShader.vertex : ''}
      void main() {
        vec4 face = texelFetch(facePoints, texelOf(gl_VertexID, facePoints), 0);
        vec3 normal = normalize(normalMatrix * texelFetch(faceNormals, texelOf(gl_VertexID, faceNormals), 0).xyz);
        vec3 up = normalize((viewMatrix * vec4(0.0, 1.0, 0.0, 0.0)).xyz);
        vec3 light = mix(below, above, 0.5 + 0.5 * dot(normal, up)) + ambient;
        for (int i = 0; i < LAMPS; ++i) light += max(dot(normal, lampWays[i]), 0.0) * lampColours[i];
        vLight = light / 3.14159;
        vColour = color;
        if (faceShow == 1) {
          vColour = vec3(1.0);
        } else if (faceShow == 2) {
          float x = clamp(face.w / farthest, 0.0, 1.0) * float(STEPS - 1);
          int low = min(int(x), STEPS - 2);
          vColour = mix(distanceColours[low], distanceColours[low + 1], x - float(low));
        } else if (faceShow == 3) {
          vColour = mix(color, regionColour, 0.72);
        }
        vUv = uv;
        ${eyes ? 'vEye = eye;' : ''}
        gl_Position = projectionMatrix * modelViewMatrix * vec4(face.xyz, 1.0);
      }`,
    fragmentShader: `
      uniform int faceShow;
      uniform sampler2D map;
      varying vec3 vLight, vColour;
      varying vec2 vUv;
      ${eyes ? eyeShader.fragment : ''}
      void main() {
        vec3 colour = vColour;
        if (faceShow == 1) colour = texture2D(map, vUv).rgb;
        #ifdef EYES
          if (faceShow == 0 && isEye()) colour = eyeballColour();
        #endif
        gl_FragColor = vec4(colour * vLight, 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
}
