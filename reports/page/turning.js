// Turns a picture with mouse and keys.
"use strict";

/**
 * Lets the user turn a picture.
 * @param node the element that shows the picture
 * @param view an object with yaw and pitch in radians, which turning changes
 * @param slowness pixels of mouse movement per radian
 * @param draw redraws the picture
 * @param others {key: function} for further keys
 */
function makeTurnable(node, view, slowness, draw, others = {}) {
  function turn(yaw, pitch) {
    view.yaw += yaw;
    view.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.pitch + pitch));
    draw();
  }
  node.addEventListener("pointerdown", (event) => node.setPointerCapture(event.pointerId));
  node.addEventListener("pointermove", (event) => {
    if (event.buttons) turn(event.movementX / slowness, event.movementY / slowness);
  });
  const keys = { ArrowLeft: () => turn(-0.2, 0), ArrowRight: () => turn(0.2, 0), ArrowUp: () => turn(0, -0.2), ArrowDown: () => turn(0, 0.2),
    ...others };
  node.addEventListener("keydown", (event) => {
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
}
