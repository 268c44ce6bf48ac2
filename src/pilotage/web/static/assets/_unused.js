const e={},n=void 0;export{n as WorkerUrl,e as default};
