# SPDX-License-Identifier: Apache-2.0
# crowdface on Debian 13, installed, built and tried by the project's own script. For Docker and Podman:
#   docker build -t crowdface .
#   docker run --rm -v "$PWD:/data" crowdface generate crowd.yaml
FROM debian:trixie-slim
COPY . /crowdface
RUN /crowdface/scripts/demo.sh \
 && cmake --install /crowdface/build/release --prefix /usr/local \
 && rm -rf /crowdface /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["crowdface"]
CMD ["--help"]
