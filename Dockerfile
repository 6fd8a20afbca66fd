# airybench and airybench-meshgen, with nothing that compiles:
#
#   docker build -t airybench .
#   docker run --rm -v "$PWD:/work" airybench --mesh=Mesh0..Mesh3
#
# Records are in results/latest of the mounted folder. Named by digest, as in .github/workflows.
ARG DEBIAN=debian:13@sha256:913f6706df59a68922d1dd08f78c2476560a8d367897200a6005b00e5f67c2d5
FROM $DEBIAN AS build
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends \
    ca-certificates dpkg-dev file git
COPY . /src
WORKDIR /src
# `run` installs what building needs; the Debian package depends on what running needs.
RUN git config --global --add safe.directory /src \
 && ./run meshgen --check >/dev/null \
 && ./run bench list >/dev/null \
 && cd build/release && cmake --build . && cpack -B /package

FROM $DEBIAN
RUN --mount=type=bind,from=build,source=/package,target=/package \
    apt-get update -qq \
 && apt-get install -y -qq --no-install-recommends /package/*.deb \
 && rm -rf /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["airybench"]
