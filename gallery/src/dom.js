// SPDX-License-Identifier: Apache-2.0

/// An element with properties and children: el('button', { class: 'big', onclick: f }, 'Open').
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

/// A slider. Letting go ends a move even if the browser sends no `change` event, as for a slider that comes back to its
/// start, or whose value the page has set during the move.
/// \param moved  (number) while it is held; \param done  (number) once it is let go
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

/// A short number: at most `digits` behind the point, no zeros at the end.
export function short(value, digits = 2) {
  return String(Number(value.toFixed(digits)));
}

const loading = new Map();

/// Loads a classic script once, which is how a page opened from disk reads data.
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
