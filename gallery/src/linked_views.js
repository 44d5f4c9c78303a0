// SPDX-License-Identifier: Apache-2.0

/// Links the cameras of several views (stage.js): a move of one camera moves all.
/// \param isLinked  function: whether the views are linked at present
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
