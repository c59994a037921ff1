project = "Sphinx"
html_show_copyright = False
extensions = ["myst_parser"]
exclude_patterns = ["_build"]

# _static/handlebody holds handlebody.standalone.js of the package's dist/, and standalone/ beside it; _static also the models.
html_static_path = ["_static"]
html_css_files = ["handlebody.css"]
html_js_files = [("handlebody/handlebody.standalone.js", {"type": "module"})]
