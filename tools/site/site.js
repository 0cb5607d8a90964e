// Formulas in TeX, which only the notebooks have: their pages fetch MathJax, without which the TeX is shown.
if (document.querySelector(".arithmatex")) {
  window.MathJax = { options: { ignoreHtmlClass: ".*", processHtmlClass: "arithmatex" } };
  const script = document.createElement("script");
  script.src = "https://unpkg.com/mathjax@3/es5/tex-svg.js";
  document.head.append(script);
}
