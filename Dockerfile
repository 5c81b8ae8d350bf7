# A virtual controller: docker run -p 127.0.0.1:11000-11002:11000-11002 rapidgen-sim irb120 --host 0.0.0.0
FROM python:3.13-slim AS build
WORKDIR /src
COPY . .
# What builds the page (Node.js) stays here. Versions are those of the lock file.
RUN python -m pip wheel --no-cache-dir --disable-pip-version-check --no-deps --wheel-dir /dist . \
    && python -m venv /opt/rapidgen \
    && /opt/rapidgen/bin/pip install --no-cache-dir --disable-pip-version-check \
        --constraint .ci/requirements.txt "$(ls /dist/*.whl)[recording,urdf,web]"

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
