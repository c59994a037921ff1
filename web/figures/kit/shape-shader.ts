/** The shape's picture, or the picked handle's weight in viridis with lines of equal weight. */
export const VERTEX = /* glsl */ `
  attribute vec2 rest;
  attribute float weight;
  uniform vec4 frame;
  varying vec2 vAt;
  varying float vWeight;

  void main() {
    vAt = (rest - frame.xy) / frame.zw;
    vWeight = weight;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position.xy, 0.0, 1.0);
  }
`;

export const FRAGMENT = /* glsl */ `
  uniform sampler2D picture;
  uniform sampler2D colors;
  uniform float showWeight;
  varying vec2 vAt;
  varying float vWeight;

  void main() {
    vec3 base = texture2D(picture, vAt).rgb;
    vec3 color = texture2D(colors, vec2(clamp(vWeight, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb;
    float gray = dot(base, vec3(0.299, 0.587, 0.114));
    color = color * (0.86 + 0.22 * gray);

    // Beyond 0 and 1 hatched, in pixels of the screen, the stronger the farther.
    float beyond = max(-vWeight, vWeight - 1.0);
    float stripe = step(0.62, fract((gl_FragCoord.x + gl_FragCoord.y) / 12.0));
    float strength = step(0.002, beyond) * (0.3 + 0.6 * smoothstep(0.0, 0.12, beyond));
    color = mix(color, vWeight < 0.0 ? vec3(0.93, 0.42, 0.66) : vec3(0.75, 0.3, 0.05), stripe * strength);

    // A line at every tenth, none where the weight is flat.
    float level = vWeight * 10.0;
    float slope = fwidth(level);
    float line = 1.0 - smoothstep(0.6, 1.4, abs(fract(level - 0.5) - 0.5) / max(slope, 1e-6));
    line *= smoothstep(0.0005, 0.004, slope) * step(0.05, abs(vWeight)) * step(abs(vWeight - 1.0), 20.0);
    color = mix(color, vWeight > 0.62 ? vec3(0.05, 0.06, 0.1) : vec3(1.0), line * 0.6);

    gl_FragColor = vec4(mix(base, color, showWeight), 1.0);
  }
`;
