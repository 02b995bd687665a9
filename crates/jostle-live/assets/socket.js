// Messages to the server of this page, over a WebSocket.

let socket = null;
/** Attempts to connect since the last connection. */
let tries = 0;

function send(message) {
  if (socket?.readyState !== WebSocket.OPEN) return false;
  socket.send(JSON.stringify(message));
  return true;
}

function connect() {
  socket = new WebSocket(`ws://${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => (tries = 0);
  socket.onmessage = ({ data }) => receive(data);
  socket.onclose = () => {
    waiting = null;
    byId("working").hidden = true;
    showWaiting();
    showConnection(say("no_connection_to_jostle"));
    tries += 1;
    setTimeout(connect, Math.min(250 * 2 ** tries, 5000));
  };
}
