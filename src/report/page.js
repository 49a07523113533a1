"use strict";
const byId = id => document.getElementById(id);
function element(tag, attributes, parent, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}
function tip(target, text) {
  target.addEventListener("mousemove", event => {
    const box = byId("tip");
    box.textContent = text;
    box.style.display = "block";
    box.style.left = Math.min(event.clientX + 14, innerWidth - box.offsetWidth - 8) + "px";
    box.style.top = Math.min(event.clientY + 14, innerHeight - box.offsetHeight - 8) + "px";
  });
  target.addEventListener("mouseleave", () => { byId("tip").style.display = "none"; });
}
