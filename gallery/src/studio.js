// SPDX-License-Identifier: Apache-2.0
// The light of contact sheets (src/crowdface/render/studio.cpp, shading.cpp and light.cpp), so that a face looks the same
// in pages and sheets.
import { Matrix3, MeshStandardMaterial, ShaderChunk, Vector3 } from 'three';

const mostShaded = 0.85; // visible fraction of the sky above which a point lies in no shadow of the key light
const rimGloss = 0.4; // factor on the highlights of the rim lights, which the face partly hides
const hairSky = 0.72; // visible fraction of the sky on hair, most of which lies under other hair

const unit = (...way) => new Vector3(...way).normalize();

/// Lamps that move with the camera: directions towards them; x right, y up, z to the camera.
export const lamps = {
  key: { way: unit(-0.62, 0.62, 0.62), colour: [1.55, 1.49, 1.39] },
  fill: { way: unit(0.85, 0.05, 0.55), colour: [0.15, 0.165, 0.185] },
  rims: [
    { way: unit(0.8, 0.35, -0.5), colour: [0.64, 0.65, 0.67] },
    { way: unit(-0.85, 0.25, -0.55), colour: [0.255, 0.26, 0.265] },
  ],
  above: [0.29, 0.3, 0.315],
  below: [0.1, 0.093, 0.086],
};

/// Per kind of surface: how far light reaches beyond the terminator, roughness, and reflectance at normal incidence.
export const surfaces = {
  skin: { wrap: [0.3, 0.19, 0.14], roughness: 0.48, reflectance: 0.03, specular: 1, darkens: true, sky: 1 },
  eye: { wrap: [0.15, 0.12, 0.1], roughness: 0.16, reflectance: 0.04, specular: 1, darkens: false, sky: 1 },
  attachment: { wrap: [0.3, 0.28, 0.26], roughness: 0.45, reflectance: 0.03, specular: 0.3, darkens: true, sky: hairSky },
};

/// The tone curve for linear values, applied before sRGB encoding: compresses highlights.
export function shoulder(x) {
  if (x <= 0.6) return x;
  const over = (x - 0.6) / 0.4;
  return 0.6 + (0.4 * over) / (1 + 0.55 * over);
}

/// Diffuse light from a lamp, also beyond the terminator.
function wrapped(cosine, wrap) {
  const lit = Math.max((cosine + wrap) / (1 + wrap), 0);
  return (0.5 * (lit * lit + lit)) / (1 + wrap);
}

/// The fraction of the key light that reaches a point, estimated from the visible fraction of the sky.
export function keyShare(sky) {
  const x = Math.min(sky / mostShaded, 1);
  return x * x * (3 - 2 * x);
}

/// The light of the sky at a point, with interreflections in crevices (Jimenez et al. 2016).
export function withBounces(sky, albedo) {
  const sum = ((sky * (2.0404 * albedo - 0.3324) + (-4.7951 * albedo + 0.6417)) * sky + (2.7552 * albedo + 0.6903)) * sky;
  return Math.min(Math.max(sum, sky), 1);
}

/// The studio's light in the axes of the turned group, for the present camera.
/// \return  diffuse(x, y, z, sky, key, open, sum): writes the diffuse light on a white surface with the normal x, y, z
///          to `sum`; gloss(x, y, z, sky, key, brightness, sum): adds the specular light towards a distant camera
export function lightIn(camera, group, kind) {
  const turn = new Matrix3().setFromMatrix4(camera.matrixWorldInverse.clone().multiply(group.matrixWorld)).transpose();
  const local = ({ way, colour }) => ({ way: way.clone().applyMatrix3(turn).normalize(), colour });
  const all = [lamps.key, lamps.fill, ...lamps.rims].map(local);
  const [key, fill, right, left] = all;
  const up = local({ way: new Vector3(0, 1, 0) }).way;
  const eye = local({ way: new Vector3(0, 0, 1) }).way;
  const { above, below } = lamps;
  const { wrap, roughness, reflectance, specular, darkens } = surfaces[kind];
  const alpha2 = roughness ** 4;
  const masking = (cosine) => cosine + Math.sqrt(alpha2 + (1 - alpha2) * cosine * cosine);
  const halves = all.map(({ way }) => way.clone().add(eye).normalize());
  const away5 = halves.map((half) => (1 - Math.max(half.dot(eye), 0)) ** 5);
  const diffuse = (x, y, z, sky, keyPart, open, sum) => {
    const facing = (way) => x * way.x + y * way.y + z * way.z;
    const high = 0.5 + 0.5 * facing(up);
    const toKey = facing(key.way);
    const toFill = facing(fill.way);
    const fromRight = sky * Math.max(facing(right.way), 0);
    const fromLeft = sky * Math.max(facing(left.way), 0);
    for (let c = 0; c < 3; c += 1) {
      sum[c] = open * (below[c] + high * (above[c] - below[c]) + fill.colour[c] * wrapped(toFill, wrap[c])) +
        keyPart * key.colour[c] * wrapped(toKey, wrap[c]) + right.colour[c] * fromRight + left.colour[c] * fromLeft;
    }
  };
  const gloss = (x, y, z, sky, keyPart, brightness, sum) => {
    const mirrored = darkens ? reflectance * Math.min(Math.max(brightness / 0.055, 0.25), 1) : reflectance;
    const toEye = masking(Math.max(x * eye.x + y * eye.y + z * eye.z, 0.05));
    for (let l = 0; l < 4; l += 1) {
      const { way, colour } = all[l];
      const facing = x * way.x + y * way.y + z * way.z;
      if (facing <= 0) continue;
      const nh = Math.max(x * halves[l].x + y * halves[l].y + z * halves[l].z, 0);
      const spread = nh * nh * (alpha2 - 1) + 1;
      const share = (specular * (l === 0 ? keyPart : l === 1 ? sky * sky : rimGloss * sky * sky) * facing * alpha2 * (mirrored + (1 - mirrored) * away5[l])) /
        (spread * spread * masking(facing) * toEye);
      for (let c = 0; c < 3; c += 1) sum[c] += share * colour[c];
    }
  };
  return { diffuse, gloss };
}

/// Formats numbers as a GLSL vector.
const text = (numbers) => `vec3(${[...numbers].map((number) => number.toFixed(6)).join(', ')})`;
const lamp = ({ way, colour }) => `${text(way)}, ${text(colour)}`;

/// GLSL: inStudio(albedo, normal, direction to the eye, surface, fraction of the sky, fraction of the key light).
const shading = `
  struct Surface { vec3 wrap; float roughness, reflectance, specular, sky; };
  vec3 wrapped(float cosine, vec3 wrap) {
    vec3 lit = max((cosine + wrap) / (1.0 + wrap), 0.0);
    return 0.5 * (lit * lit + lit) / (1.0 + wrap);
  }
  vec3 withBounces(float sky, vec3 albedo) {
    vec3 sum = ((sky * (2.0404 * albedo - 0.3324) + (-4.7951 * albedo + 0.6417)) * sky + (2.7552 * albedo + 0.6903)) * sky;
    return clamp(sum, sky, 1.0);
  }
  float masking(float cosine, float alpha2) { return cosine + sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine); }
  float gloss(vec3 n, vec3 eye, vec3 to, float alpha2, float reflectance) { // Walter et al. 2007
    float nl = dot(n, to);
    if (nl <= 0.0) return 0.0;
    vec3 h = normalize(to + eye);
    float nh = max(dot(n, h), 0.0), away = 1.0 - max(dot(eye, h), 0.0), away2 = away * away;
    float spread = nh * nh * (alpha2 - 1.0) + 1.0;
    float fresnel = reflectance + (1.0 - reflectance) * away2 * away2 * away;
    return nl * alpha2 * fresnel / (spread * spread * masking(nl, alpha2) * masking(max(dot(n, eye), 0.05), alpha2));
  }
  vec3 lampLight(vec3 way, vec3 colour, vec3 n, vec3 eye, vec3 diffuse, float alpha2, float reflectance, float shine) {
    return colour * (diffuse + shine * gloss(n, eye, way, alpha2, reflectance));
  }
  vec3 inStudio(vec3 albedo, vec3 n, vec3 eye, Surface surface, float sky, float key) {
    vec3 open = withBounces(sky, albedo);
    float rough = max(surface.roughness, 0.14), alpha2 = rough * rough * rough * rough, soft = surface.specular * sky * sky;
    vec3 toKey = ${text(lamps.key.way)}, toFill = ${text(lamps.fill.way)};
    vec3 light = albedo * open * mix(${text(lamps.below)}, ${text(lamps.above)}, 0.5 + 0.5 * n.y);
    light += lampLight(${lamp(lamps.key)}, n, eye, albedo * key * wrapped(dot(n, toKey), surface.wrap), alpha2, surface.reflectance, surface.specular * key);
    light += lampLight(${lamp(lamps.fill)}, n, eye, albedo * open * wrapped(dot(n, toFill), surface.wrap), alpha2, surface.reflectance, soft);
    ${lamps.rims.map((rim) => `light += lampLight(${lamp(rim)}, n, eye, albedo * sky * max(dot(n, ${text(rim.way)}), 0.0), alpha2, surface.reflectance, ${rimGloss} * soft);`).join('\n    ')}
    return light;
  }
  // Pages trace no shadow rays: points that see little of the sky get little of the key light.
  float keyShare(float sky) { return smoothstep(0.0, ${mostShaded.toFixed(2)}, sky); }
  vec3 shoulder(vec3 x) {
    vec3 over = max(x - 0.6, 0.0) / 0.4;
    return min(x, 0.6) + 0.4 * over / (1.0 + 0.55 * over);
  }`;

/// The smooth normal decides which side of a surface faces the camera. If the triangle decided, as in three.js, coarse
/// triangles at the edge of a jaw would be lit from behind and show as bright specks.
const faceDirection = ShaderChunk.normal_fragment_begin.replace('gl_FrontFacing', '!isInside()');

/// A surface as GLSL.
function surfaceText(kind, roughness = surfaces[kind].roughness.toFixed(3)) {
  const { wrap, reflectance, specular, sky } = surfaces[kind];
  return `Surface(${text(wrap)}, ${roughness}, ${[reflectance, specular, sky].map((number) => number.toFixed(3)).join(', ')})`;
}

/// Adds a change to the material's shaders.
/// \param change  function that modifies the text of a shader
export function extend(material, change) {
  const before = material.onBeforeCompile;
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    change(shader);
  };
}

/// \param kind      of `surfaces`
/// \param options   options of three.js materials
/// \param skin      {lightness: {value}}: lightness of the skin in the texture; darker texels are painted hair
export function studioMaterial(kind, options, skin = { value: 0 }) {
  const { roughness, darkens } = surfaces[kind];
  const material = new MeshStandardMaterial({ roughness, ...options });
  extend(material, (shader) => {
    shader.uniforms.skinLightness = skin;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>
        #ifdef HAS_SKY
          attribute float sky;
          varying float vSky;
        #endif`)
      .replace('#include <project_vertex>', `#include <project_vertex>
        #ifdef HAS_SKY
          vSky = sky;
        #endif`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        uniform float skinLightness;
        #ifdef HAS_SKY
          varying float vSky;
        #endif
        ${shading}`)
      .replace('#include <normal_pars_fragment>', `#include <normal_pars_fragment>
        bool isInside() { return dot(normalize(vNormal), normalize(vViewPosition)) < -0.4; }`)
      .replace('#include <normal_fragment_begin>', faceDirection)
      .replace('#include <lights_physical_fragment>', '').replace('#include <lights_fragment_begin>', '')
      .replace('#include <lights_fragment_maps>', '').replace('#include <lights_fragment_end>', '')
      .replace('#include <opaque_fragment>', `
        Surface surface = ${surfaceText(kind, 'roughnessFactor')};
        vec3 eyeWay = normalize(vViewPosition);
        float brightness = dot(diffuseColor.rgb, vec3(1.0 / 3.0));
        ${darkens ? `surface.reflectance *= clamp(brightness / 0.055, 0.25, 1.0);
        if (skinLightness > 0.0) surface.specular *= mix(0.12, 1.0, clamp((brightness / skinLightness - 0.15) / 0.55, 0.0, 1.0));` : ''}
        #ifdef HAS_SKY
          surface.sky = vSky;
        #endif
        // <surface>
        normal = dot(normal, eyeWay) < 0.0 ? normalize(normal - dot(normal, eyeWay) * eyeWay) : normal;
        outgoingLight = inStudio(diffuseColor.rgb, normal, eyeWay, surface, surface.sky, keyShare(surface.sky));
        if (isInside()) outgoingLight *= 0.3;
        outgoingLight = shoulder(outgoingLight);
        #include <opaque_fragment>`);
  });
  return material;
}

/// Uses another surface kind where a GLSL condition holds.
export function surfaceWhere(shader, condition, kind) {
  shader.fragmentShader = shader.fragmentShader.replace('// <surface>', `// <surface>
        if (${condition}) {
          float seen = surface.sky;
          surface = ${surfaceText(kind)};
          surface.sky = seen;
        }`);
}
