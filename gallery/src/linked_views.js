// SPDX-License-Identifier: Apache-2.0

/// One camera for several views (stage.js): where one looks from, all look from.
/// \param isLinked  whether they follow each other now
export function linkViews(views, isLinked = () => true) {
  let isFollowing = false;
  const others = (view, act) => {
    if (isFollowing || view.silent || !isLinked()) return;
    isFollowing = true;
    for (const other of views) if (other !== view) act(other);
    isFollowing = false;
  };
  for (const view of views) {
    view.controls.addEventListener('change', () => others(view, (other) => other.lookAs(view)));
    view.controls.addEventListener('start', () => others(view, (other) => other.setMoving(true)));
    view.controls.addEventListener('end', () => others(view, (other) => other.setMoving(false)));
  }
}
