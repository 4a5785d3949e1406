// A client of Foxglove's WebSocket protocol that wants every topic that it can decode; it connects again by itself.
import { decoders } from "./messages.js";

const kProtocol = "foxglove.websocket.v1";
const kAgain = 1000; // [ms] from a connection that is lost to the next attempt
const kMessageData = 1;
const kHead = 13; // [bytes] before a message

export class Connection {
  /** `listener` has open(name), lost(), status(text) and message(topic, decoded). */
  constructor(address, listener) {
    Object.assign(this, { address, listener, topics: new Map() });
    this.connect();
  }

  connect() {
    this.topics.clear();
    this.socket = new WebSocket(this.address, [kProtocol]);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("message", ({ data }) => (typeof data === "string" ? this.takeText(JSON.parse(data)) : this.takeMessage(data)));
    this.socket.addEventListener("close", () => {
      this.listener.lost();
      setTimeout(() => this.connect(), kAgain);
    });
  }

  takeText(text) {
    if (text.op === "serverInfo") this.listener.open(text.name, text.sessionId);
    if (text.op === "status") this.listener.status(text.message);
    if (text.op !== "advertise") return;
    const wanted = text.channels.filter((channel) => decoders[channel.topic]);
    for (const channel of wanted) this.topics.set(channel.id, channel.topic);
    this.socket.send(JSON.stringify({ op: "subscribe", subscriptions: wanted.map(({ id }) => ({ id, channelId: id })) }));
  }

  takeMessage(buffer) {
    const view = new DataView(buffer);
    if (view.getUint8(0) !== kMessageData) return;
    const topic = this.topics.get(view.getUint32(1, true));
    this.listener.message(topic, decoders[topic](new DataView(buffer, kHead)));
  }
}
