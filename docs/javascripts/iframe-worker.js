// The search of the site runs in a worker, which browsers refuse to pages that are opened from a file: there it runs in a
// hidden frame. The theme looks for `IFrameWorker` in the frame's parent, and calls `importScripts` there.
if (location.protocol === "file:") {
  window.IFrameWorker = class extends EventTarget {
    constructor(url) {
      super()
      const frame = document.createElement("iframe")
      frame.hidden = true
      document.body.append(frame)
      const inner = (this.inner = frame.contentWindow)
      const tell = data => this.dispatchEvent(new MessageEvent("message", { data }))
      const load = address =>
        new Promise((loaded, failed) => {
          const script = inner.document.createElement("script")
          Object.assign(script, { src: address, async: false, onload: loaded, onerror: failed })
          inner.document.body.append(script)
        })
      inner.postMessage = data => setTimeout(tell, 0, data)
      inner.importScripts = (...addresses) => Promise.all(addresses.map(load))
      this.ready = load(new URL(url, location.href).href)
    }

    postMessage(data) {
      this.ready.then(() => this.inner.dispatchEvent(new MessageEvent("message", { data })))
    }

    terminate() {
      this.inner.frameElement.remove()
    }
  }
  window.Worker = window.IFrameWorker
}
