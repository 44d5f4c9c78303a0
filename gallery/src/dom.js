// SPDX-License-Identifier: Apache-2.0

/// Creates an element with properties and children: el('button', { class: 'big', onclick: f }, 'Open').
export function el(tag, properties = {}, ...children) {
  const svg = ['svg', 'g', 'circle', 'line', 'text', 'image', 'clipPath', 'path', 'rect', 'title'];
  const node = svg.includes(tag)
    ? document.createElementNS('http://www.w3.org/2000/svg', tag)
    : document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (name === 'value' || name === 'checked' || name === 'disabled') node[name] = value;
    else node.setAttribute(name, value === true ? '' : value);
  }
  if (node.matches('button, select, input') && !node.title) node.title = properties['aria-label'] ?? '';
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

/// Creates a slider. Releasing it ends a move even if the browser sends no `change` event, because the slider is back at
/// its start or the page has set its value during the move.
/// \param moved  called with the value while the slider is dragged
/// \param done   called with the value when the slider is released
export function sliderNode(properties, moved, done) {
  let isHeld = false;
  const end = () => {
    if (!isHeld) return;
    isHeld = false;
    done(Number(node.value));
  };
  const node = el('input', {
    ...properties, type: 'range', onchange: end, onpointerup: end, onpointercancel: end,
    oninput: () => {
      isHeld = true;
      moved(Number(node.value));
    },
  });
  return node;
}

/// Formats a number with at most `digits` decimals and no trailing zeros.
export function short(value, digits = 2) {
  return String(Number(value.toFixed(digits)));
}

const loading = new Map();

/// Loads a script that is not a module, once. Pages opened from disk read their data this way, because browsers load no
/// modules from disk.
export function loadScript(path) {
  if (!loading.has(path)) {
    loading.set(path, new Promise((resolve, reject) => {
      const script = el('script', { src: path.split('/').map(encodeURIComponent).join('/') });
      script.onload = () => resolve();
      script.onerror = () => {
        loading.delete(path);
        reject(new Error(`${path} is missing`));
      };
      document.head.append(script);
    }));
  }
  return loading.get(path);
}
