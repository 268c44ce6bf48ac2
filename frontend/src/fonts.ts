// Where the editor finds its fonts: in the package, never elsewhere. Must be imported before the editor.
window.EXCALIDRAW_ASSET_PATH = `${location.origin}/assets/`;
