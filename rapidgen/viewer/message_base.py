"""Base classes of the page's messages."""

from pydantic import BaseModel, ConfigDict


class MessageModel(BaseModel):
    """Base of the parts of messages."""

    model_config = ConfigDict(frozen=True, extra="forbid")
