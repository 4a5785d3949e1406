#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include <tilth/core/error.hpp>
#include <tilth/view/foxglove.hpp>
#include <tilth/view/view_hub.hpp>
#include <tilth/view/view_page.hpp>
#include <tilth/view/view_server.hpp>

namespace tilth {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

constexpr std::size_t kMostConnections = 32;
constexpr std::size_t kMostInbox = 100;  // messages that the server's thread has not yet taken
constexpr int kFarewells = 50;           // looks at what still waits when the server ends
constexpr std::chrono::milliseconds kBetweenFarewells{20};
constexpr std::chrono::milliseconds kBetweenAttempts{100};  // to accept, where that fails

Tcp::acceptor listening(asio::io_context& io, const ViewAddress& address) {
  boost::system::error_code error;
  const asio::ip::address host = asio::ip::make_address(address.host, error);
  if (error) throw Error("view_host", "\"" + address.host + "\" is no address like 127.0.0.1");
  for (const std::uint16_t port : {address.port, std::uint16_t{0}}) {
    try {
      return Tcp::acceptor(io, Tcp::endpoint(host, port));
    } catch (const boost::system::system_error& e) {
      error = e.code();
    }
  }
  throw Error("view_host", address.host + ": " + error.message());
}

std::string session_name() {
  return std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}

}  // namespace

class ViewServer::Impl {
 public:
  Impl(const ViewAddress& address, const std::string& name)
      : acceptor_(listening(io_, address)), port_(acceptor_.local_endpoint().port()) {
    hub_.page = view_page();
    hub_.page_policy = view_page_policy();
    hub_.greetings = {server_info(name, session_name()), advertisement(view_channels())};
    accept();
    thread_ = std::thread([this] { io_.run(); });
  }

  ~Impl() {
    asio::post(io_, [this] { finish(); });
    thread_.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::uint16_t port() const { return port_; }
  bool wanted(RunTopic topic) const { return hub_.wanted[std::size_t(topic)]; }

  void send(ViewMessage message) {
    const std::lock_guard lock(mutex_);
    if (inbox_.size() >= kMostInbox) inbox_.pop_front();
    inbox_.push_back(std::move(message));
    if (inbox_.size() == 1) asio::post(io_, [this] { take_inbox(); });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) return accept_later();
      if (hub_.connections < kMostConnections) serve(std::move(socket), hub_);
      accept();
    });
  }

  void accept_later() {
    timer_.expires_after(kBetweenAttempts);
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error && acceptor_.is_open()) accept();
    });
  }

  void take_inbox() {
    std::deque<ViewMessage> messages;
    {
      const std::lock_guard lock(mutex_);
      messages.swap(inbox_);
    }
    for (const ViewMessage& message : messages) {
      hub_.last[std::size_t(message.topic)] = message;
      for (ViewClient* client : std::vector(hub_.clients)) client->offer(message);
    }
  }

  void finish() {
    acceptor_.close();
    take_inbox();
    for (ViewClient* client : std::vector(hub_.clients)) client->finish();
    farewell(kFarewells);
  }

  void farewell(int left) {
    if (hub_.connections == 0 || left == 0) return io_.stop();
    timer_.expires_after(kBetweenFarewells);
    timer_.async_wait([this, left](boost::system::error_code) { farewell(left - 1); });
  }

  ViewHub hub_;  // outlives the connections, which io_ holds
  asio::io_context io_{1};
  asio::steady_timer timer_{io_};
  Tcp::acceptor acceptor_;
  std::uint16_t port_;
  std::mutex mutex_;
  std::deque<ViewMessage> inbox_;
  std::thread thread_;
};

ViewServer::ViewServer(const ViewAddress& address, const std::string& name)
    : impl_(std::make_unique<Impl>(address, name)) {}

ViewServer::~ViewServer() = default;

std::uint16_t ViewServer::port() const {
  return impl_->port();
}

bool ViewServer::wanted(RunTopic topic) const {
  return impl_->wanted(topic);
}

void ViewServer::send(RunTopic topic, double stamp, std::vector<std::byte> message) {
  impl_->send({topic, nanoseconds(stamp), std::make_shared<const std::vector<std::byte>>(std::move(message))});
}

}  // namespace tilth
