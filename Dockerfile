# SPDX-License-Identifier: Apache-2.0
# crowdface on Debian 13, from the packages that scripts/package.sh builds: the program and the Python module.
# For Docker and Podman:
#   docker build -t crowdface .
#   docker run --rm -v "$PWD:/data" crowdface generate crowd.yaml
FROM debian:trixie-slim AS build
COPY . /crowdface
RUN /crowdface/scripts/package.sh

FROM debian:trixie-slim
COPY --from=build /crowdface/build/packages /packages
RUN apt-get update \
 && apt-get install -y --no-install-recommends /packages/crowdface_*.deb /packages/python3-crowdface_*.deb \
 && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["crowdface"]
CMD ["--help"]
