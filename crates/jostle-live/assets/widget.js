// Messages to the engine of a notebook: the frame around this page carries them.

function send(message) {
  parent.postMessage({ jostle: JSON.stringify(message) }, "*");
  return true;
}

function connect() {
  addEventListener("message", ({ data, source }) => {
    if (source === parent && data?.answer !== undefined) receive(data.answer);
  });
  send({ op: "hello" });
}
