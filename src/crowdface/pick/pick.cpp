// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick.h"

#include "crowdface/core/interrupt.h"
#include "crowdface/page/local_server.h"
#include "crowdface/pick/pick_api.h"

namespace crowdface {

void pick_landmarks(PickScans& scans, const PickOptions& options,
                    const std::function<void(const std::string&)>& started) {
  PickApi api(scans, options.pages, options.most_triangles);
  LocalServer server([&](const HttpRequest& request) { return api.answer(request); }, options.port);
  started(server.address());
  server.run(interrupted);
}

}  // namespace crowdface
