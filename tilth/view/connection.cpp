#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <utility>

#include <tilth/view/foxglove.hpp>
#include <tilth/view/view_hub.hpp>
#include <tilth/view/visitor.hpp>

namespace tilth {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Request = http::request<http::empty_body>;

constexpr std::size_t kMostHeader = 8192;      // [bytes] of a request
constexpr std::size_t kMostMessage = 1 << 16;  // [bytes] of a client's message
constexpr std::chrono::seconds kPatience{10};  // for a request, and for a page to be taken

/// Is counted while it is there.
struct Counted {
  explicit Counted(ViewHub& to) : hub(to) { ++hub.connections; }
  ~Counted() { --hub.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ViewHub& hub;
};

class WebSocketClient final : public ViewClient, public std::enable_shared_from_this<WebSocketClient> {
 public:
  WebSocketClient(beast::tcp_stream stream, ViewHub& hub)
      : counted_(hub), hub_(hub), socket_(std::move(stream)), in_(kMostMessage), feed_(hub.greetings) {}

  ~WebSocketClient() override {
    std::erase(hub_.clients, this);
    hub_.recount();
  }

  void open(const Request& request, std::string_view protocol) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has a clock of its own
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.set_option(
        websocket::stream_base::decorator([name = std::string(protocol)](websocket::response_type& answer) {
          answer.set(http::field::sec_websocket_protocol, name);
        }));
    socket_.read_message_max(kMostMessage);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->hub_.clients.push_back(self.get());
      self->open_ = true;
      self->read();
      self->write();
    });
  }

  const ClientFeed& feed() const override { return feed_; }

  void offer(const ViewMessage& message) override {
    feed_.offer(message);
    write();
  }

  void finish() override {
    finishing_ = true;
    write();
  }

 private:
  void read() {
    socket_.async_read(in_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->end();
      self->take();
      self->write();
      self->read();
    });
  }

  void take() {
    const std::string_view text(static_cast<const char*>(in_.data().data()), in_.size());
    if (socket_.got_text()) {
      for (const RunTopic topic : feed_.take_text(text)) {
        if (const auto& last = hub_.last[std::size_t(topic)]) feed_.offer(*last);
      }
    } else {
      feed_.take_binary();
    }
    in_.consume(in_.size());
    hub_.recount();
    if (feed_.flooding()) end();
  }

  /// Sends what is next, unless something is on its way.
  void write() {
    if (!open_ || going_) return;
    going_ = feed_.next();
    if (!going_) {
      if (std::exchange(finishing_, false)) close();
      return;
    }
    socket_.text(going_->is_text);
    std::array<boost::asio::const_buffer, 2> parts{boost::asio::buffer(going_->text), {}};
    if (going_->bytes) parts[1] = boost::asio::buffer(*going_->bytes);
    socket_.async_write(parts, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->end();
      self->going_.reset();
      self->write();
    });
  }

  void close() {
    open_ = false;
    socket_.async_close(websocket::close_code::going_away, [self = shared_from_this()](beast::error_code) {});
  }

  void end() {
    open_ = false;
    beast::get_lowest_layer(socket_).close();
  }

  Counted counted_;
  ViewHub& hub_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer in_;
  ClientFeed feed_;
  std::optional<ViewFrame> going_;
  bool open_ = false, finishing_ = false;
};

/// One request: it gets the page, or becomes a WebSocket.
class HttpConnection final : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, ViewHub& hub)
      : counted_(hub), hub_(hub), stream_(std::move(socket)), in_(2 * kMostHeader) {
    parser_.header_limit(kMostHeader);
    parser_.body_limit(0);
  }

  void open() {
    stream_.expires_after(kPatience);
    http::async_read(stream_, in_, parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->take(self->parser_.get());
    });
  }

 private:
  void take(const Request& request) {
    if (!websocket::is_upgrade(request)) return answer_plain(request);
    const std::string_view protocol = chosen_protocol(text_of(request[http::field::sec_websocket_protocol]));
    if (in_.size() > 0) return answer(http::status::bad_request, "wait for the handshake (RFC 6455, 4.1)\n");
    if (protocol.empty()) return answer(http::status::bad_request, "this server speaks foxglove.sdk.v1\n");
    if (!may_visit(text_of(request[http::field::origin]), text_of(request[http::field::host])))
      return answer(http::status::forbidden, "pages from elsewhere are not served\n");
    std::make_shared<WebSocketClient>(std::move(stream_), hub_)->open(request, protocol);
  }

  static std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

  void answer_plain(const Request& request) {
    const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
    if (!reads) return answer(http::status::method_not_allowed, "GET only\n");
    if (request.target() != "/") return answer(http::status::not_found, "there is one page, at /\n");
    answer(http::status::ok, hub_.page);
  }

  void answer(http::status status, std::string body) {
    const bool page = status == http::status::ok;
    answer_ = {status, 11};
    answer_.set(http::field::content_type, page ? "text/html; charset=utf-8" : "text/plain; charset=utf-8");
    answer_.set(http::field::cache_control, "no-store");
    answer_.set("X-Content-Type-Options", "nosniff");
    if (page) answer_.set("Content-Security-Policy", hub_.page_policy);
    answer_.keep_alive(false);
    if (parser_.get().method() != http::verb::head) answer_.body() = std::move(body);
    answer_.prepare_payload();
    stream_.expires_after(kPatience);
    http::async_write(stream_, answer_, [self = shared_from_this()](beast::error_code, std::size_t) {
      beast::error_code ignored;
      self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    });
  }

  Counted counted_;
  ViewHub& hub_;
  beast::tcp_stream stream_;
  beast::flat_buffer in_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> answer_;
};

}  // namespace

void serve(boost::asio::ip::tcp::socket socket, ViewHub& hub) {
  std::make_shared<HttpConnection>(std::move(socket), hub)->open();
}

}  // namespace tilth
