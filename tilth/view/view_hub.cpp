#include <tilth/view/view_hub.hpp>

namespace tilth {

void ViewHub::recount() {
  for (std::size_t topic = 0; topic < kRunTopics; ++topic) {
    bool any = false;
    for (const ViewClient* client : clients) any = any || client->feed().subscribed(RunTopic(topic));
    wanted[topic] = any;
  }
}

}  // namespace tilth
