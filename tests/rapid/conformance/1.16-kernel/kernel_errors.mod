! rule: the error numbers of the language
! source: [K §12]
MODULE Demo
    PROC main()
        IF ERRNO = ERR_ALRDYCNT TPErase;
        IF ERRNO = ERR_ARGDUPCND TPErase;
        IF ERRNO = ERR_ARGNOTPER TPErase;
        IF ERRNO = ERR_ARGNOTVAR TPErase;
        IF ERRNO = ERR_CALLPROC TPErase;
        IF ERRNO = ERR_CNTNOTVAR TPErase;
        IF ERRNO = ERR_DIVZERO TPErase;
        IF ERRNO = ERR_EXECPHR TPErase;
        IF ERRNO = ERR_FNCNORET TPErase;
        IF ERRNO = ERR_ILLDIM TPErase;
        IF ERRNO = ERR_ILLQUAT TPErase;
        IF ERRNO = ERR_ILLRAISE TPErase;
        IF ERRNO = ERR_INOMAX TPErase;
        IF ERRNO = ERR_MAXINTVAL TPErase;
        IF ERRNO = ERR_NEGARG TPErase;
        IF ERRNO = ERR_NOTARR TPErase;
        IF ERRNO = ERR_NOTEQDIM TPErase;
        IF ERRNO = ERR_NOTINTVAL TPErase;
        IF ERRNO = ERR_NOTPRES TPErase;
        IF ERRNO = ERR_OUTOFBND TPErase;
        IF ERRNO = ERR_REFUNKDAT TPErase;
        IF ERRNO = ERR_REFUNKFUN TPErase;
        IF ERRNO = ERR_REFUNKPRC TPErase;
        IF ERRNO = ERR_REFUNKTRP TPErase;
        IF ERRNO = ERR_STRTOOLNG TPErase;
        IF ERRNO = ERR_UNKINO TPErase;
    ENDPROC
ENDMODULE
