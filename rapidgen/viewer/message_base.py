"""What all messages of the page have in common."""

from pydantic import BaseModel, ConfigDict


class MessageModel(BaseModel):
    """What is inside of messages."""

    model_config = ConfigDict(frozen=True, extra="forbid")
