// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick.h"

#include <utility>

#include "crowdface/core/interrupt.h"
#include "crowdface/page/local_server.h"
#include "crowdface/pick/pick_api.h"

namespace crowdface {

void pick_landmarks(PickInputs inputs, const PickOptions& options,
                    const std::function<void(const std::string&)>& started) {
  PickSession session(std::move(inputs));
  PickApi api(session, options.pages, options.most_triangles);
  LocalServer server([&](const HttpRequest& request) { return api.answer(request); }, options.port);
  started(server.address());
  server.run(interrupted);
}

}  // namespace crowdface
