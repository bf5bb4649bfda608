# The web app of ehlectric in a container, with the locked versions of its dependencies, each file checked by its hash:
#   docker build -t ehlectric .
#   docker run --rm -p 8080:8080 ehlectric
# It prints an address with a token, http://localhost:8080/?token=... Open it as it is on this machine; on another one put
# the name of this machine in place of localhost. If you publish another port (-p 9000:8080), change the port too.
FROM python:3.13-slim
WORKDIR /source
COPY . .
RUN pip install --no-cache-dir --require-hashes --requirement requirements.hashes \
 && pip install --no-cache-dir --no-deps --no-build-isolation . \
 && rm -r /source \
 && useradd --create-home ehlectric
USER ehlectric
WORKDIR /home/ehlectric
EXPOSE 8080
# Ctrl-C and docker stop end the app with all that it computes.
STOPSIGNAL SIGINT
ENTRYPOINT ["ehlectric", "app", "--host", "0.0.0.0", "--port", "8080", "--no-browser"]
