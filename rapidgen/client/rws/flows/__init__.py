"""What the client does step by step: generators over `effects`."""

from rapidgen.client.rws.flows import connecting, holding, panel, rapid, signals

__all__ = ["connecting", "holding", "panel", "rapid", "signals"]
